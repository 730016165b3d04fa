#include "stream/adapt/stream_policy.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

#include "stream/protocol/saturate.h"

namespace grove::stream {
namespace {

constexpr double kMinWidth = 160;
constexpr double kMinHeight = 90;
constexpr double kMaxWidth = 1920;
constexpr double kMaxHeight = 1080;

struct Rung {
  double scale;  ///< of width and height
  double rate;   ///< of the wanted frames a second
};
/// Each rung takes an eighth to a third less than the previous one. 1280 x 720 at 30 frames goes down to 480 lines
/// before frames become fewer, and stays there down to 20.
constexpr std::array<Rung, 11> kLadder = {{{1.0, 1.0},
                                           {0.85, 1.0},
                                           {0.75, 1.0},
                                           {2.0 / 3.0, 1.0},
                                           {2.0 / 3.0, 0.87},
                                           {2.0 / 3.0, 2.0 / 3.0},
                                           {0.5, 2.0 / 3.0},
                                           {0.5, 0.5},
                                           {1.0 / 3.0, 0.5},
                                           {1.0 / 3.0, 1.0 / 3.0},
                                           {0.25, 1.0 / 6.0}}};
/// Shares of the range from the finest to the coarsest quantiser: above the first, the stream steps down; below the
/// second, there is room for the next better rung.
constexpr double kTight = 0.80;
constexpr double kRoomy = 0.66;
constexpr double kTightSeconds = 0.15;
constexpr double kRoomySeconds = 2.0;
/// At the beginning, the required rung was a guess.
constexpr double kFirstRoomySeconds = 0.3;
/// The rate of a line that has never been full is unknown: the estimate may grow tenfold in this time.
constexpr double kUntriedSeconds = 0.6;
/// An excess this large takes effect at once, if the line's rate is known.
constexpr double kMuchTooTight = 4.0;
/// Smaller pictures have more detail per pixel: bits grow with this power of the pixels.
constexpr double kDetail = 0.85;

/// Returns the quantiser that this rung would need.
Quantiser needed(const Rung& rung, const StreamWish& wish, const StreamMeans& means) {
  const double whole = static_cast<double>(wish.width) * wish.height;
  const double pixels = whole * std::pow(rung.scale * rung.scale, kDetail);
  const double bits = means.bitsPerSecond / std::min(wish.framesPerSecond * rung.rate, means.framesPerSecond);
  return 6.0 * std::log2(std::max(1e-9, means.bitsPerPixel * pixels / bits));
}

/// Returns how far a rung's quantiser exceeds the bound; negative: within.
double excess(const Rung& rung, const StreamWish& wish, const StreamMeans& means, double share) {
  const double bound = means.finest + share * (means.coarsest - means.finest);
  return needed(rung, wish, means) - bound;
}

}  // namespace

std::pair<int, int> fitSize(std::uint32_t width, std::uint32_t height) {
  const double w = std::max(1.0, static_cast<double>(width));
  const double h = std::max(1.0, static_cast<double>(height));
  const double grow = std::max({1.0, kMinWidth / w, kMinHeight / h});
  const double scale = std::min({grow, kMaxWidth / w, kMaxHeight / h});
  const auto even = [&](double size, double min) {
    return 2 * static_cast<int>(std::max(min, std::round(size * scale)) / 2.0);
  };
  return {even(w, kMinWidth), even(h, kMinHeight)};
}

world::Camera withBorder(world::Camera camera, int percent) {
  const double wider = 1.0 + percent / 100.0;
  camera.verticalFov = static_cast<float>(2.0 * std::atan(wider * std::tan(0.5 * camera.verticalFov)));
  std::tie(camera.width, camera.height) =
      fitSize(saturate<std::uint32_t>(camera.width * wider), saturate<std::uint32_t>(camera.height * wider));
  return camera;
}

void StreamPolicy::step(double now, const StreamWish& wish, const StreamMeans& means) {
  const double beyond = excess(kLadder[rung_], wish, means, kTight);
  if (beyond > 0.0 && rung_ + 1 < kLadder.size()) {
    roomySince_ = -1.0;
    if (tightSince_ < 0.0) tightSince_ = now;
    const bool isCertain = means.isTried && beyond >= kMuchTooTight;
    if (!isCertain && now - tightSince_ < (means.isTried ? kTightSeconds : kUntriedSeconds)) return;
    while (rung_ + 1 < kLadder.size() && excess(kLadder[rung_], wish, means, kTight) > 0.0) ++rung_;
    tightSince_ = -1.0;
    return;
  }
  tightSince_ = -1.0;
  if (rung_ == 0 || excess(kLadder[rung_ - 1], wish, means, kRoomy) > 0.0) {
    roomySince_ = -1.0;
    return;
  }
  if (roomySince_ < 0.0) roomySince_ = now;
  if (now - roomySince_ < (means.isTried ? kRoomySeconds : kFirstRoomySeconds)) return;
  --rung_;
  roomySince_ = now;
}

const StreamPlan& StreamPolicy::update(double now, const StreamWish& wish, const StreamMeans& means) {
  step(now, wish, means);
  const Rung& rung = kLadder[rung_];
  const auto scaled = [&](int side) { return static_cast<std::uint32_t>(std::lround(side * rung.scale)); };
  std::tie(plan_.width, plan_.height) = fitSize(scaled(wish.width), scaled(wish.height));
  plan_.framesPerSecond = std::max(1.0, wish.framesPerSecond * rung.rate);
  plan_.limitedBy = rung_ == 0 ? LimitedBy::kNothing : LimitedBy::kLine;
  return plan_;
}

}  // namespace grove::stream
