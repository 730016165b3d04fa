#pragma once

#include <algorithm>
#include <cstddef>
#include <stop_token>

#include "cli/bench/warp/film.h"
#include "cli/bench/warp/sent_walk.h"
#include "measure/pictures/picture_quality.h"

namespace grove::cli {

/// Picture error of the frames of a walk.
class Errors {
 public:
  void add(double meanSquareError) {
    sum_ += meanSquareError;
    worst_ = std::max(worst_, meanSquareError);
    ++count_;
  }
  /// Decibels.
  [[nodiscard]] double mean() const { return measure::decibels(sum_ / std::max(count_, 1.0)); }
  [[nodiscard]] double worst() const { return measure::decibels(worst_); }

 private:
  double sum_ = 0.0;
  double worst_ = 0.0;
  double count_ = 0.0;
};

/// What a page shows of a walk, against what the visitor should see.
struct WarpReport {
  std::size_t frames = 0;
  Errors moved;
  Errors turned;  ///< by late look alone
  Errors none;    ///< pictures as they come
  double pictureBytes = 0.0;
  double spaceBytes = 0.0;
  double cpuMilliseconds = 0.0;  ///< per picture

  [[nodiscard]] double bitsMore() const { return spaceBytes / std::max(pictureBytes, 1.0); }
};

/// Streams a walk over a line with a round trip of `delay` milliseconds, and shows it as a page does. A film, if given,
/// has the pictures of a page without late walk on the left, not encoded, and those of a page with it on the right.
/// Throws EnvironmentError if a codec or the disk fails.
[[nodiscard]] WarpReport showLate(SentWalk& frames, double delay, Film* film, const std::stop_token& stop);

}  // namespace grove::cli
