#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "measure/pictures/picture_quality.h"

namespace grove::measure {

/// How many blocks of 16 x 16 pixels of a film move otherwise than those of a reference film of the same size do. The
/// motion of a block is where the last picture has the block most like it (least sum of absolute differences of the
/// luma, whole pixels, kSearch to each side). A block jumps if it is much more like where it has moved from than where
/// the reference's block has moved from, give or take a pixel. So flat blocks, what appears and what fades do not
/// count. Blocks nearer than kSearch to an edge are left out, and those whose reference moves by about as much as that.
class BlockJumps {
 public:
  static constexpr int kBlock = 16;
  static constexpr int kSearch = 14;
  /// Of 255, by how much a pixel must at least be better explained in the mean, and by which share.
  static constexpr int kGain = 4;
  static constexpr double kGainShare = 0.5;

  /// The next picture of both films.
  void add(const Picture& shown, const Picture& reference);

  /// Of all pairs of consecutive pictures so far.
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
