#include <algorithm>
#include <cmath>
#include <limits>

#include "stream/adapt/stream_control.h"

// Size, rate, codec and border of the next frames.
namespace grove::stream {
namespace {

/// Usable share of the estimated rate; the rest covers errors of the estimate.
constexpr double kUsable = 0.8;
/// A view counts as still after this: a visitor who stops for a moment will walk on.
constexpr double kStillSeconds = 2.0;
/// A picture that is coarser than usual by this has no border.
constexpr Quantiser kBorderQuantisers = 6.0;
/// Smaller limits are raised to these.
constexpr double kMinKilobits = 200.0;
constexpr int kMinLines = 90;
/// Measured on a walk through the grove, in JPEG of the usual quality.
constexpr double kJpegBitsPerPixel = 1.1;
/// A trial of JPEG begins with this multiple of its bit rate.
constexpr double kTrust = 1.3;

}  // namespace

StreamWish StreamControl::wish(const Governor::Share& share) const {
  StreamWish wish;
  double scale = share.scale;
  if (limits_.lines > 0) scale = std::min(scale, std::max<double>(kMinLines, limits_.lines) / height_);
  wish.width = static_cast<int>(std::lround(width_ * scale));
  wish.height = static_cast<int>(std::lround(height_ * scale));
  wish.framesPerSecond = serverFramesPerSecond_;
  if (limits_.framesPerSecond > 0)
    wish.framesPerSecond = std::min<double>(wish.framesPerSecond, limits_.framesPerSecond);
  if (moves()) wish.framesPerSecond = std::min(wish.framesPerSecond, share.movedPerSecond);
  return wish;
}

double StreamControl::wantedBitsPerSecond() const {
  return limits_.kilobitsPerSecond > 0 ? std::max<double>(kMinKilobits, limits_.kilobitsPerSecond) * 1000.0
                                       : LinkEstimator::kMaxBitsPerSecond;
}

double StreamControl::bitsPerSecond() const { return kUsable * std::min(link_.bitsPerSecond(), wantedBitsPerSecond()); }

void StreamControl::plan(double now) {
  if (page_ == PageLevel::kBasic) {
    policy_.update(now, wish({}), {.bitsPerSecond = std::numeric_limits<double>::infinity()});
    return;
  }
  const Governor::Share share = governed_.update(work_.pace(policy_.plan().framesPerSecond, moves(), now), now);
  policy_.update(now, work_.relieve(wish(share), now),
                 {.bitsPerSecond = bitsPerSecond(),
                  .bitsPerPixel = quantisers_.complexity(),
                  .framesPerSecond = work_.framesPerSecond(),
                  .finest = range_.finest,
                  .coarsest = range_.coarsest,
                  .isTried = link_.isMeasured()});
  planCodec(now);
}

void StreamControl::planCodec(double now) {
  const StreamPlan& plan = policy_.plan();
  const double jpeg =
      kJpegBitsPerPixel * plan.width * plan.height * std::min(plan.framesPerSecond, work_.framesPerSecond());
  const bool before = codecChoice_.savesWork();
  const bool savesWork = codecChoice_.update(
      now, {.isWorkScarce = work_.shortOf() == LimitedBy::kMachine || isGoverned(),
            .isBrowserShort = work_.shortOf() == LimitedBy::kBrowser,
            .isStill = now - moved_ > kStillSeconds,
            .isLineScarce = plan.limitedBy == LimitedBy::kLine || work_.shortOf() == LimitedBy::kLine,
            .lineBitsPerSecond = bitsPerSecond(),
            .provenBitsPerSecond = std::min(link_.proven(), wantedBitsPerSecond()),
            .workSaverBitsPerSecond = jpeg});
  if (savesWork && !before) link_.trust(kTrust * jpeg / kUsable);
}

void StreamControl::planBorder() {
  const bool hasRoom = policy_.plan().limitedBy == LimitedBy::kNothing && work_.shortOf() == LimitedBy::kNothing &&
                       newestQuantiser_ <= range_.usual + (border_.percent() > 0 ? kBorderQuantisers : 0.0);
  border_.update(page_ >= PageLevel::kAdaptive && limits_.border && hasRoom, link_.roundTrip());
}

bool StreamControl::moves() const { return page_ >= PageLevel::kMoving && limits_.nearness; }

bool StreamControl::isGoverned() const {
  const Governor::Share share = governed_.share();
  return share.scale < 1.0 || (moves() && share.movedPerSecond < serverFramesPerSecond_);
}

}  // namespace grove::stream
