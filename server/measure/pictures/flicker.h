#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "measure/pictures/picture_quality.h"

namespace grove::measure {

/// Measures flicker: the share of blocks of 16 x 16 pixels whose mean luma is more than 8 of 255 above that of the same
/// block in both neighbouring pictures, or more than 8 below both. So content that appears and disappears counts;
/// content that moves on or fades in one direction does not. Each block counts once for each picture that has both
/// neighbours; blocks at the right and the lower edge may be smaller.
class Flicker {
 public:
  static constexpr int kBlock = 16;
  static constexpr double kThreshold = 8.0;

  /// Adds the next picture, of the same size as the previous ones.
  void add(const Picture& picture);

  /// 0 to 1; 0 before the third picture.
  [[nodiscard]] double share() const noexcept;

 private:
  std::array<std::vector<double>, 3> means_;  ///< by block, of the last three pictures, the newest last
  std::size_t pictures_ = 0;
  std::uint64_t jumps_ = 0;
  std::uint64_t blocks_ = 0;  ///< with both neighbours
};

}  // namespace grove::measure
