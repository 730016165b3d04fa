#include "cli/refiner.h"

#include <pthread.h>
#include <sched.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <utility>

#include "base/log.h"

namespace grove::cli {
namespace {

using stream::Refining;
using namespace std::chrono_literals;

constexpr auto kBetweenNews = 1s;
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

Refiner::Refiner(std::vector<WantedField> wanted, Show show, Tell tell)
    : wanted_(std::move(wanted)),
      show_(std::move(show)),
      tell_(std::move(tell)),
      thread_([this](const std::stop_token& stop) { run(stop); }) {
  pthread_setname_np(thread_.native_handle(), "grove-refine");
  log::info("finer light fields are made while the world is shown: " + std::to_string(wanted_.size()));
}

Refiner::~Refiner() = default;

void Refiner::run(const std::stop_token& stop) {
  runWhenIdle();
  try {
    const FieldLock lock(fieldFolder() / "lock");
    for (std::size_t i = 0; i < wanted_.size(); ++i) {
      if (!refine(i, lock, stop)) return;
    }
    log::info("all light fields are as fine as the scene wants them: " + inSeconds(seconds()) + " in all");
  } catch (const std::exception& e) {
    log::error(std::string(e.what()) + "; the light fields that are left stay coarse");
  }
  tell_({.percent = 100, .secondsLeft = 0, .step = {}});
}

bool Refiner::refine(std::size_t index, const FieldLock& lock, const std::stop_token& stop) {
  const WantedField& wanted = wanted_[index];
  const std::filesystem::path& file = wanted.source.file;
  const auto isThere = [&] {
    std::error_code ignored;
    return std::filesystem::exists(file, ignored) && openField(file).index() == 0;
  };
  const Clock::time_point begin = Clock::now();
  progressed(index, 0.0F, nameOf(wanted));
  bool madeHere = false;
  while (!isThere()) {
    if (!lock.take()) {
      // Another server makes it, or one that comes before it.
      std::this_thread::sleep_for(200ms);
      if (stop.stop_requested()) return false;
      continue;
    }
    const auto tell = [&](const bake::BakeProgress& now) { progressed(index, shareOf(now), nameOf(wanted)); };
    madeHere = !isThere();
    const bool made = !madeHere || bakeField(wanted, tell, stop);
    lock.give();
    if (!made) return false;
    if (madeHere) break;
  }
  if (stop.stop_requested()) return false;
  show_(file);
  const auto left = secondsLeft(shareDone(index, 1.0F));
  log::info("finer light field " + std::to_string(index + 1) + " of " + std::to_string(wanted_.size()) + ", " +
            nameOf(wanted) + ": " + inSeconds(std::chrono::duration<double>(Clock::now() - begin).count()) +
            (madeHere ? "" : ", by another server") +
            (left && index + 1 < wanted_.size() ? "; about " + inSeconds(*left) + " left" : ""));
  return true;
}

void Refiner::progressed(std::size_t index, float share, const std::string& step) {
  const Clock::time_point now = Clock::now();
  if (told_ && now - *told_ < kBetweenNews) return;
  told_ = now;
  const float done = shareDone(index, share);
  Refining news;
  news.percent = static_cast<std::uint8_t>(std::clamp(std::floor(100.0F * done), 0.0F, 99.0F));
  if (const auto left = secondsLeft(done)) {
    news.secondsLeft = static_cast<std::uint16_t>(std::min(*left, Refining::kUnknownSeconds - 1.0));
  }
  news.step = step;
  tell_(news);
}

double Refiner::seconds() const { return std::chrono::duration<double>(Clock::now() - begin_).count(); }

float Refiner::shareDone(std::size_t index, float share) const {
  float all = 0.0F;
  float done = 0.0F;
  for (std::size_t i = 0; i < wanted_.size(); ++i) {
    const float cost = costOf(wanted_[i]);
    all += cost;
    if (i <= index) done += i < index ? cost : share * cost;
  }
  return done / all;
}

std::optional<double> Refiner::secondsLeft(float shareDone) const {
  if (shareDone < kMinShare) return std::nullopt;
  const auto share = static_cast<double>(shareDone);
  return seconds() * (1.0 - share) / share;
}

}  // namespace grove::cli
