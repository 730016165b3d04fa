#include "stream/adapt/browser_relief.h"

#include <algorithm>
#include <array>

namespace grove::stream {
namespace {

constexpr std::array<BrowserRelief::Share, 5> kSteps = {
    {{1.0, 1.0}, {2.0 / 3.0, 1.0}, {2.0 / 3.0, 0.85}, {2.0 / 3.0, 2.0 / 3.0}, {0.5, 0.5}}};
/// A browser is strained if it keeps frames back for this share of the time, and fewer come than this share of what is
/// sent for: to send less would gain nothing else.
constexpr double kStrained = 0.25;
constexpr double kTooFew = 0.7;
constexpr double kStrainedSeconds = 2.0;
constexpr double kMinPatience = 10.0;
constexpr double kMaxPatience = 160.0;
/// Who is strained so soon after a step up has been asked for too much, and is asked less often.
constexpr double kFailedTrySeconds = 8.0;

}  // namespace

const BrowserRelief::Share& BrowserRelief::share() const noexcept { return kSteps[step_]; }

const BrowserRelief::Share& BrowserRelief::update(double now, double blocked, double achieved, double wanted) {
  const bool isStrained = blocked > kStrained && achieved < kTooFew * wanted * kSteps[step_].rate;
  if (!isStrained) {
    strainedSince_ = -1.0;
    if (step_ > 0 && now - changed_ > patience_) {
      --step_;
      changed_ = now;
    }
    return share();
  }
  if (strainedSince_ < 0.0) strainedSince_ = now;
  if (now - strainedSince_ < kStrainedSeconds || step_ + 1 == kSteps.size()) return share();
  const bool failed = changed_ > 0.0 && now - changed_ < kFailedTrySeconds;
  patience_ = failed ? std::min(kMaxPatience, 2.0 * patience_) : std::max(kMinPatience, patience_);
  ++step_;
  changed_ = now;
  strainedSince_ = -1.0;
  return share();
}

}  // namespace grove::stream
