#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "measure/pictures/picture_quality.h"

namespace grove::measure {

/// Counts the blocks of 16 x 16 pixels in a film that move differently from the same blocks of a reference film of the
/// same size. A block's motion leads to the most similar block of the previous picture (minimum sum of absolute
/// differences of the luma, whole pixels, up to kSearch in each direction). A block jumps if its own motion explains it
/// much better than the reference's motion, with a tolerance of one pixel. So flat blocks, appearing and fading content
/// do not count. Blocks closer than kSearch to an edge are skipped, and blocks whose reference moves by about that
/// much.
class BlockJumps {
 public:
  static constexpr int kBlock = 16;
  static constexpr int kSearch = 14;
  /// Minimum improvement of a jump: per pixel in the mean, of 255, and as a share.
  static constexpr int kGain = 4;
  static constexpr double kGainShare = 0.5;

  /// Adds the next picture of both films.
  void add(const Picture& shown, const Picture& reference);

  /// Over all pairs of consecutive pictures so far.
  [[nodiscard]] std::size_t jumps() const noexcept { return jumps_; }
  [[nodiscard]] std::size_t pairs() const noexcept { return pairs_; }

 private:
  using Luma = std::vector<std::uint8_t>;
  Luma lastShown_;
  Luma lastReference_;
  std::size_t jumps_ = 0;
  std::size_t pairs_ = 0;
};

}  // namespace grove::measure
