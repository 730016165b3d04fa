#include "stream/adapt/relief.h"

#include <algorithm>

namespace grove::stream {
namespace {

/// Frames that are kept back for less of the time than this do no harm.
constexpr double kStrained = 0.25;
constexpr double kStrainedSeconds = 2.0;
constexpr double kMinPatience = 10.0;
constexpr double kMaxPatience = 160.0;
/// Who is strained so soon after a step up has been asked for too much, and is asked less often.
constexpr double kFailedTrySeconds = 8.0;

}  // namespace

const Relief::Share& Relief::update(double now, double blocked, double achieved, double wanted) {
  const bool isStrained = blocked > kStrained && achieved < tooFew_ * wanted * steps_[step_].rate;
  if (!isStrained) {
    strainedSince_ = -1.0;
    if (step_ > 0 && now - changed_ > patience_) {
      --step_;
      changed_ = now;
    }
    return share();
  }
  if (strainedSince_ < 0.0) strainedSince_ = now;
  if (now - strainedSince_ < kStrainedSeconds || step_ + 1 == steps_.size()) return share();
  const bool failed = changed_ > 0.0 && now - changed_ < kFailedTrySeconds;
  patience_ = failed ? std::min(kMaxPatience, 2.0 * patience_) : std::max(kMinPatience, patience_);
  ++step_;
  changed_ = now;
  strainedSince_ = -1.0;
  return share();
}

}  // namespace grove::stream
