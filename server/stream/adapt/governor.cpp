#include "stream/adapt/governor.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace grove::stream {
namespace {

constexpr std::array<double, 4> kScales = {1.0, 5.0 / 6.0, 2.0 / 3.0, 0.5};
/// A frame's cost goes with this power of width and height: a part of it does not depend on the pixels. Measured with
/// four walking visitors on two cores: 13, 24 and 27 frames a second at 720, 480 and 360 lines.
constexpr double kCostExponent = 1.5;
/// Of the wanted frames a second: 28 of 30.
constexpr double kEnough = 0.93;
/// Due frames that wait for less of the time than this are not what slows a stream down.
constexpr double kMinDelayed = 0.04;
/// Pictures shrink when frames of so many seconds are missing: soon where half of them are, late where a tenth is.
constexpr double kMissingSeconds = 0.25;
/// Of the workers, that larger pictures may be expected to need. Those of a busy machine are less accurate, and so cost
/// less than expected (node/load_shedding.h).
constexpr double kRoom = 1.1;
constexpr double kAssessedEvery = 0.25;
constexpr double kBusyCalming = 0.1;
constexpr double kFirstPatience = 10.0;
constexpr double kLongestPatience = 160.0;
/// Pictures that have to shrink so soon after they grew are given twice as long until the next try.
constexpr double kTrialSeconds = 20.0;

double costOf(std::size_t step) { return std::pow(kScales[step], kCostExponent); }

}  // namespace

Governor::Stream::Stream(Governor& governor)
    : governor_(governor), pace_([&] {
        const std::lock_guard lock(governor.mutex_);
        return governor.paces_.emplace(governor.paces_.end());
      }()) {}

Governor::Stream::~Stream() {
  const std::lock_guard lock(governor_.mutex_);
  governor_.paces_.erase(pace_);
}

double Governor::Stream::update(const std::optional<Pace>& pace, double now) {
  const std::lock_guard lock(governor_.mutex_);
  *pace_ = pace;
  if (now - governor_.assessed_ >= kAssessedEvery) governor_.assess(now);
  return kScales[governor_.step_];
}

void Governor::Stream::rest() {
  const std::lock_guard lock(governor_.mutex_);
  pace_->reset();
}

double Governor::scale() const {
  const std::lock_guard lock(mutex_);
  return kScales[step_];
}

void Governor::assess(double now) {
  const double passed = std::min(now - std::exchange(assessed_, now), kAssessedEvery);
  busy_ += kBusyCalming * (busyShare_() - busy_);
  double wanted = 0.0;
  double achieved = 0.0;
  double delayed = 0.0;
  double streams = 0.0;
  for (const std::optional<Pace>& pace : paces_) {
    if (!pace) continue;
    wanted += pace->wanted;
    achieved += std::min(pace->achieved, pace->wanted);
    delayed += pace->delayed;
    ++streams;
  }
  if (achieved >= kEnough * wanted || delayed <= kMinDelayed * streams) {
    missing_ = 0.0;
    growIfThereIsRoom(now);
    return;
  }
  missing_ += passed * (1.0 - achieved / (kEnough * wanted));
  if (missing_ >= kMissingSeconds) shrink(now, achieved, wanted);
}

void Governor::shrink(double now, double achieved, double wanted) {
  const std::size_t last = kScales.size() - 1;
  if (step_ == last) return;
  const bool failed = grew_ && now - changed_ < kTrialSeconds;
  patience_ = failed ? std::min(kLongestPatience, 2.0 * patience_) : kFirstPatience;
  const double reached = achieved * costOf(step_);
  ++step_;
  while (step_ < last && reached < kEnough * wanted * costOf(step_)) ++step_;
  grew_ = false;
  changed_ = now;
  missing_ = 0.0;
}

void Governor::growIfThereIsRoom(double now) {
  if (step_ == 0 || now - changed_ < patience_) return;
  if (busy_ * costOf(step_ - 1) / costOf(step_) > kRoom) return;
  --step_;
  grew_ = true;
  changed_ = now;
}

}  // namespace grove::stream
