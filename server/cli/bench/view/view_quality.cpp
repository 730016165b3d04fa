#include "cli/bench/view/view_quality.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "cli/bench/walk/walk_visitor.h"
#include "measure/pictures/flicker.h"
#include "measure/pictures/picture_quality.h"

namespace grove::cli {
namespace {

/// Sums over frames.
class QualityMeter {
 public:
  void add(const measure::Picture& shown, const measure::Picture& reference) {
    all_.resize(shown.colour.size(), 1);
    const double error = measure::meanSquareError(shown, reference, all_);
    sum_ += error;
    worst_ = std::max(worst_, error);
    ++frames_;
    flicker_.add(shown);
    flickerReference_.add(reference);
  }

  [[nodiscard]] std::optional<ViewQuality> quality() const {
    if (frames_ == 0) return std::nullopt;
    return ViewQuality{measure::decibels(sum_ / frames_), measure::decibels(worst_), flicker_.share(),
                       flickerReference_.share()};
  }

 private:
  measure::Mask all_;
  int frames_ = 0;
  double sum_ = 0.0;    ///< of mean square errors
  double worst_ = 0.0;  ///< mean square error
  measure::Flicker flicker_;
  measure::Flicker flickerReference_;
};

}  // namespace

std::optional<ViewQuality> measureViewQuality(WalkWorld& world, const world::Walk& walk, double seconds,
                                              const PictureSize& size, const std::stop_token& stop) {
  WalkVisitor visitor(world, {.number = 1, .size = size});
  WalkVisitor reference(world, {.number = 2, .size = size, .policy = wholePolicy()});
  QualityMeter meter;
  const auto drawBoth = [&](const Moment& moment) {
    visitor.begin(moment);
    reference.begin(moment);
    return std::pair(visitor.take(), reference.take());
  };
  world.walk(
      walk, seconds, Pace::kThirtyASecond, [&](const Moment& moment) { static_cast<void>(drawBoth(moment)); },
      [&](const Moment& moment) {
        const auto [shown, whole] = drawBoth(moment);
        const std::vector<std::uint32_t> pixels = raster::rgbaOf(*shown.picture);
        const std::vector<std::uint32_t> wanted = raster::rgbaOf(*whole.picture);
        meter.add({pixels, size.width}, {wanted, size.width});
      },
      stop);
  return meter.quality();
}

}  // namespace grove::cli
