#include "stream/adapt/relief.h"

#include <algorithm>

namespace grove::stream {
namespace {

/// Below this share of time with blocked frames, no relief is needed.
constexpr double kStrained = 0.25;
constexpr double kStrainedSeconds = 2.0;
/// Below this share of time with blocked frames, spare capacity is unknown, so a step up may be tried.
constexpr double kIdle = 0.1;
constexpr double kMinPatience = 10.0;
constexpr double kMaxPatience = 160.0;
/// Strain this soon after a step up means that the try failed; tries then become rarer.
constexpr double kFailedTrySeconds = 8.0;

}  // namespace

bool Relief::suffices(std::size_t step, double achieved, double wanted) const {
  const double ratio = share().scale / steps_[step].scale;
  return achieved * ratio * ratio >= tooFew_ * wanted * steps_[step].rate;
}

const Relief::Share& Relief::update(double now, double blocked, double achieved, double wanted) {
  if (blocked <= kStrained || suffices(step_, achieved, wanted)) {
    strainedSince_ = -1.0;
    const bool mayTry = step_ > 0 && now - changed_ > patience_;
    if (mayTry && (blocked <= kIdle || suffices(step_ - 1, achieved, wanted))) {
      --step_;
      changed_ = now;
    }
    return share();
  }
  if (strainedSince_ < 0.0) strainedSince_ = now;
  if (now - strainedSince_ < kStrainedSeconds || step_ + 1 == steps_.size()) return share();
  const bool failed = changed_ > 0.0 && now - changed_ < kFailedTrySeconds;
  patience_ = failed ? std::min(kMaxPatience, 2.0 * patience_) : std::max(kMinPatience, patience_);
  std::size_t next = step_ + 1;
  while (next + 1 < steps_.size() && !suffices(next, achieved, wanted)) ++next;
  step_ = next;
  changed_ = now;
  strainedSince_ = -1.0;
  return share();
}

}  // namespace grove::stream
