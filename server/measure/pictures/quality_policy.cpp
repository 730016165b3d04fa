#include "measure/pictures/quality_policy.h"

#include <cstddef>

namespace grove::measure {
namespace {

/// Returns the minimum number of visitors at a step: none pays more than a single visitor for step 0.
double minVisitors(int step) { return QualityPolicy::kCosts[static_cast<std::size_t>(step)]; }

/// Tolerance of the minimum, so that rounding or one missing visitor does not change the step.
constexpr double kGrace = 0.9;

}  // namespace

int QualityPolicy::update(double now, const QualityLoad& load) {
  if (now < changed_ + kSettling) return step_;
  if (step_ > 0 && inTrouble(load)) {
    moveTo(step_ - 1, now);
    notBefore_ = now + kRegret;
    return step_;
  }
  if (step_ + 1 >= kQualitySteps || now < notBefore_ || !hasRoom(load)) {
    roomSince_ = -1.0;
    return step_;
  }
  if (roomSince_ < 0.0) roomSince_ = now;
  if (now >= roomSince_ + kPatience) moveTo(step_ + 1, now);
  return step_;
}

bool QualityPolicy::inTrouble(const QualityLoad& load) const {
  return load.busyCores > kCrowdedShare * load.cores || load.frameShare < kMinFrameShare ||
         load.visitors < kGrace * minVisitors(step_);
}

bool QualityPolicy::hasRoom(const QualityLoad& load) const {
  const double growth = minVisitors(step_ + 1) / minVisitors(step_);
  const double then = load.busyCores + (growth - 1.0) * load.acrossUserCores;
  return load.frameShare >= kMinFrameShare && load.visitors >= minVisitors(step_ + 1) &&
         then <= kRoomyShare * load.cores;
}

void QualityPolicy::moveTo(int step, double now) {
  step_ = step;
  changed_ = now;
  roomSince_ = -1.0;
}

}  // namespace grove::measure
