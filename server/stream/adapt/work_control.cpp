#include "stream/adapt/work_control.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "stream/adapt/link_estimator.h"

namespace grove::stream {
namespace {

/// A page that usually takes longer than this from arrival to paint is busy: a screen frame and a decoder take half of
/// it.
constexpr double kBusyHold = 0.040;
constexpr double kHoldCalming = 0.1;
/// On a shorter line, an application-limited stream waits for the browser, not for the line.
constexpr double kNearRoundTrip = 0.020;
/// Server and browser may achieve this multiple of what they did.
constexpr double kGrowth = 1.25;
constexpr double kShareOfLine = 0.15;
constexpr double kShareOfOthers = 0.15;
constexpr double kJudgedEvery = 0.5;
/// An overloaded browser first shows fewer frames, evenly spaced.
constexpr std::array<Relief::Share, 5> kBrowserSteps = {
    {{1.0, 1.0}, {2.0 / 3.0, 1.0}, {2.0 / 3.0, 0.85}, {2.0 / 3.0, 2.0 / 3.0}, {0.5, 0.5}}};
constexpr double kTooFewForBrowser = 0.7;
/// Higher frame rates do not justify smaller pictures.
constexpr double kUsualFramesPerSecond = 30.0;

}  // namespace

WorkControl::WorkControl() : browser_(kBrowserSteps, kTooFewForBrowser) {}

void WorkControl::held(double seconds) { held_ += kHoldCalming * (seconds - held_); }

void WorkControl::waitsForPage(const LinkEstimator& link, double now) {
  const bool isNear = link.isApplicationLimited() && link.roundTrip() < kNearRoundTrip;
  shortage_.blocked(held_ > kBusyHold || isNear ? LimitedBy::kBrowser : LimitedBy::kLine, now);
}

std::optional<Governor::Pace> WorkControl::pace(double wanted, bool moves, double now) const {
  const double achieved = shortage_.framesPerSecond();
  const double others = shortage_.share(LimitedBy::kLine, now) + shortage_.share(LimitedBy::kBrowser, now);
  if (achieved <= 0.0 || others >= kShareOfOthers) return std::nullopt;
  return Governor::Pace{std::min(wanted, kUsualFramesPerSecond), achieved, shortage_.share(LimitedBy::kMachine, now),
                        moves};
}

StreamWish WorkControl::relieve(StreamWish wish, double now) {
  if (now - judged_ >= kJudgedEvery) {
    judged_ = now;
    shortOf_ = shortage_.main(now);
  }
  const double achieved = shortage_.framesPerSecond();
  const bool isKnown = achieved > 0.0 && shortage_.share(LimitedBy::kLine, now) < kShareOfLine;
  framesPerSecond_ = isKnown ? kGrowth * achieved + 1.0 : std::numeric_limits<double>::infinity();
  const Relief::Share& browser =
      browser_.update(now, shortage_.share(LimitedBy::kBrowser, now), achieved, wish.framesPerSecond);
  wish.framesPerSecond *= browser.rate;
  wish.width = static_cast<int>(std::lround(wish.width * browser.scale));
  wish.height = static_cast<int>(std::lround(wish.height * browser.scale));
  return wish;
}

}  // namespace grove::stream
