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

#include "base/cache_folder.h"
#include "base/error.h"
#include "base/log.h"
#include "cli/prepare/preparation_lock.h"

namespace grove::cli {
namespace {

using stream::Refining;
using namespace std::chrono_literals;

constexpr auto kBetweenNews = 1s;
/// Between two checks for parts made by other servers.
constexpr auto kBetweenLooks = 1s;
/// Share from which on the remaining time can be estimated.
constexpr float kMinShare = 0.02F;

/// Lets this thread, and those that it starts, run only on idle cores.
void runWhenIdle() {
  const sched_param none{};
  if (sched_setscheduler(0, SCHED_IDLE, &none) != 0 && nice(19) == -1) {
    log::warning("the world is refined at the priority of visitors' frames: the system refuses a lower one");
  }
}

float costOf(const Preparations& preparations) {
  float sum = 0.0F;
  for (const auto& each : preparations) sum += each->cost();
  return sum;
}

std::string inSeconds(double seconds) {
  char text[32];
  std::snprintf(text, sizeof text, "%.0f s", seconds);
  return text;
}

}  // namespace

Refiner::Refiner(Preparations wanted, Report report)
    : left_(std::move(wanted)), costAll_(costOf(left_)), report_(std::move(report)) {
  log::info("refining the world while it is shown: " + std::to_string(left_.size()) + " parts are still coarse");
  thread_ = std::jthread([this](const std::stop_token& stop) { run(stop); });
  pthread_setname_np(thread_.native_handle(), "grove-refine");
}

Refiner::~Refiner() = default;

void Refiner::run(const std::stop_token& stop) {
  runWhenIdle();
  try {
    const PreparationLock lock(cacheFolder() / "lock");
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
      // The other server may have made the next one just before it released the lock.
      const bool isMade = left_.front()->show() || makeNext(stop);
      lock.give();
      if (!isMade) return;
    }
    log::info("the world is as fine as the scene wants it: " + inSeconds(seconds()) + " in all");
  } catch (const std::exception& e) {
    log::error(std::string(e.what()) + "; what is left stays coarse");
  }
  report_({.percent = 100, .secondsLeft = 0, .step = {}});
}

void Refiner::showWhatIsThere() {
  for (auto next = left_.begin(); next != left_.end();) {
    if (!(*next)->show()) {
      ++next;
      continue;
    }
    ++shown_;
    costDone_ += (*next)->cost();
    const auto seconds = secondsLeft(shareDone(0.0F));
    log::info("finer " + std::string((*next)->kind()) + " " + std::to_string(shown_) + " of " +
              std::to_string(shown_ - 1 + left_.size()) + ", " + (*next)->name() +
              (seconds && left_.size() > 1 ? "; about " + inSeconds(*seconds) + " left" : ""));
    next = left_.erase(next);
  }
}

bool Refiner::makeNext(const std::stop_token& stop) {
  node::Preparation& next = *left_.front();
  if (!next.make([this](std::string_view /*step*/, float share) { progressed(share); }, stop)) return false;
  if (next.show()) return true;
  throw EnvironmentError("the " + std::string(next.kind()) + " cannot be read again", next.name(), "check the disk");
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
  news.step = left_.front()->name();
  report_(news);
}

double Refiner::seconds() const { return std::chrono::duration<double>(Clock::now() - begin_).count(); }

float Refiner::shareDone(float shareOfNext) const {
  const float ofNext = left_.empty() ? 0.0F : shareOfNext * left_.front()->cost();
  return (costDone_ + ofNext) / costAll_;
}

std::optional<double> Refiner::secondsLeft(float shareDone) const {
  if (shareDone < kMinShare) return std::nullopt;
  const auto share = static_cast<double>(shareDone);
  return seconds() * (1.0 - share) / share;
}

}  // namespace grove::cli
