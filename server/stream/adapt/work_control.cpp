#include "stream/adapt/work_control.h"

#include <cmath>

#include "stream/adapt/link_estimator.h"

namespace grove::stream {
namespace {

/// A page that usually takes longer than this from arrival to paint is busy: a frame of the screen and a decoder take
/// half of it.
constexpr double kBusyHold = 0.040;
constexpr double kHoldCalming = 0.1;
/// Over a shorter line than this, what makes no queue of its own does not wait for the line.
constexpr double kNearRoundTrip = 0.020;
/// Server and browser may manage this much more than they did.
constexpr double kGrowth = 1.25;
constexpr double kShareOfLine = 0.15;
constexpr double kJudgedEvery = 0.5;

}  // namespace

void WorkControl::held(double seconds) { held_ += kHoldCalming * (seconds - held_); }

void WorkControl::waitsForPage(const LinkEstimator& link, double now) {
  const bool isNear = link.isApplicationLimited() && link.roundTrip() < kNearRoundTrip;
  shortage_.blocked(held_ > kBusyHold || isNear ? LimitedBy::kBrowser : LimitedBy::kLine, now);
}

StreamWish WorkControl::relieve(StreamWish wish, double now) {
  if (now - judged_ >= kJudgedEvery) {
    judged_ = now;
    shortOf_ = shortage_.main(now);
  }
  const double achieved = shortage_.framesPerSecond();
  const bool isKnown = achieved > 0.0 && shortage_.share(LimitedBy::kLine, now) < kShareOfLine;
  framesPerSecond_ = isKnown ? kGrowth * achieved + 1.0 : std::numeric_limits<double>::infinity();
  const BrowserRelief::Share& share =
      relief_.update(now, shortage_.share(LimitedBy::kBrowser, now), achieved, wish.framesPerSecond);
  wish.framesPerSecond *= share.rate;
  wish.width = static_cast<int>(std::lround(wish.width * share.scale));
  wish.height = static_cast<int>(std::lround(wish.height * share.scale));
  return wish;
}

}  // namespace grove::stream
