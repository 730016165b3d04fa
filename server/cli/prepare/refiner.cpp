#include "cli/prepare/refiner.h"

#include <pthread.h>
#include <sched.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <condition_variable>
#include <cstdio>
#include <exception>
#include <mutex>
#include <system_error>
#include <utility>

#include "base/error.h"
#include "base/log.h"
#include "objects/lightfield/file/light_field_file.h"

namespace grove::cli {
namespace {

using stream::Refining;
using namespace std::chrono_literals;

constexpr auto kBetweenNews = 1s;
/// Between two looks for what other servers have made.
constexpr auto kBetweenLooks = 1s;
/// Before that a guess of the time that is left would be wild.
constexpr float kMinShare = 0.02F;

/// Of the time that one takes: the rest are views and the file.
constexpr float kLightShare = 0.6F;
constexpr float kViewsShare = 0.35F;

/// This thread and those that it starts run only where a core has nothing else to do.
void runWhenIdle() {
  const sched_param none{};
  if (sched_setscheduler(0, SCHED_IDLE, &none) != 0 && nice(19) == -1) {
    log::warning("light fields are made at the priority of visitors' frames: the system refuses a lower one");
  }
}

/// Measured: light is found for every sun apart, the rest of the work is once for all.
float costOf(const WantedField& wanted) {
  return static_cast<float>(wanted.source.lightings + 3) * static_cast<float>(wanted.source.size * wanted.source.size);
}

float costOf(const std::vector<WantedField>& wanted) {
  float sum = 0.0F;
  for (const WantedField& each : wanted) sum += costOf(each);
  return sum;
}

bool canOpen(const std::filesystem::path& file) {
  std::error_code ignored;
  if (!std::filesystem::exists(file, ignored)) return false;
  try {
    static_cast<void>(objects::lightfield::openLightField(file));
    return true;
  } catch (const objects::lightfield::LightFieldError&) {
    return false;
  }
}

float shareOf(const bake::BakeProgress& progress) {
  if (progress.step == "light") return kLightShare * progress.share;
  if (progress.step == "views") return kLightShare + kViewsShare * progress.share;
  return progress.step == "file" ? kLightShare + kViewsShare : 0.0F;
}

std::string inSeconds(double seconds) {
  char text[32];
  std::snprintf(text, sizeof text, "%.0f s", seconds);
  return text;
}

}  // namespace

Refiner::Refiner(std::vector<WantedField> wanted, Show show, Report report)
    : left_(std::move(wanted)), costAll_(costOf(left_)), show_(std::move(show)), report_(std::move(report)) {
  log::info("finer light fields are made while the world is shown: " + std::to_string(left_.size()));
  thread_ = std::jthread([this](const std::stop_token& stop) { run(stop); });
  pthread_setname_np(thread_.native_handle(), "grove-refine");
}

Refiner::~Refiner() = default;

void Refiner::run(const std::stop_token& stop) {
  runWhenIdle();
  try {
    const FieldLock lock(fieldFolder() / "lock");
    while (!left_.empty()) {
      showWhatIsThere();
      if (left_.empty()) break;
      if (stop.stop_requested()) return;
      progressed(0.0F);
      if (!lock.take()) {
        // Another server makes one.
        wait(stop);
        continue;
      }
      // It may have made the next one just before it gave the lock.
      const bool isMade = canOpen(left_.front().source.file) || makeNext(stop);
      lock.give();
      if (!isMade) return;
    }
    log::info("all light fields are as fine as the scene wants them: " + inSeconds(seconds()) + " in all");
  } catch (const std::exception& e) {
    log::error(std::string(e.what()) + "; the light fields that are left stay coarse");
  }
  report_({.percent = 100, .secondsLeft = 0, .step = {}});
}

void Refiner::showWhatIsThere() {
  for (auto next = left_.begin(); next != left_.end();) {
    if (!canOpen(next->source.file)) {
      ++next;
      continue;
    }
    show_(next->source.file);
    ++shown_;
    costDone_ += costOf(*next);
    const auto seconds = secondsLeft(shareDone(0.0F));
    log::info("finer light field " + std::to_string(shown_) + " of " + std::to_string(shown_ - 1 + left_.size()) +
              ", " + nameOf(*next) + (seconds && left_.size() > 1 ? "; about " + inSeconds(*seconds) + " left" : ""));
    next = left_.erase(next);
  }
}

bool Refiner::makeNext(const std::stop_token& stop) {
  const WantedField& next = left_.front();
  if (!bakeField(
          next, [this](const bake::BakeProgress& now) { progressed(shareOf(now)); }, stop))
    return false;
  if (canOpen(next.source.file)) return true;
  throw EnvironmentError("the light field cannot be read again", next.source.file.string(), "look at the disk");
}

void Refiner::wait(const std::stop_token& stop) {
  std::mutex mutex;
  std::unique_lock lock(mutex);
  std::condition_variable_any().wait_for(lock, stop, kBetweenLooks, [] { return false; });
}

void Refiner::progressed(float share) {
  const Clock::time_point now = Clock::now();
  if (reported_ && now - *reported_ < kBetweenNews) return;
  reported_ = now;
  const float done = shareDone(share);
  Refining news;
  news.percent = static_cast<std::uint8_t>(std::clamp(std::floor(100.0F * done), 0.0F, 99.0F));
  if (const auto left = secondsLeft(done)) {
    news.secondsLeft = static_cast<std::uint16_t>(std::min(*left, Refining::kUnknownSeconds - 1.0));
  }
  news.step = nameOf(left_.front());
  report_(news);
}

double Refiner::seconds() const { return std::chrono::duration<double>(Clock::now() - begin_).count(); }

float Refiner::shareDone(float shareOfNext) const {
  const float ofNext = left_.empty() ? 0.0F : shareOfNext * costOf(left_.front());
  return (costDone_ + ofNext) / costAll_;
}

std::optional<double> Refiner::secondsLeft(float shareDone) const {
  if (shareDone < kMinShare) return std::nullopt;
  const auto share = static_cast<double>(shareDone);
  return seconds() * (1.0 - share) / share;
}

}  // namespace grove::cli
