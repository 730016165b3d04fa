#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "measure/pictures/picture_quality.h"

namespace grove::measure {

/// How much of a film jumps: the share of blocks of 16 x 16 pixels whose mean luma lies more than 8 of 255 above that
/// of the same block in both neighbouring pictures, or as much below both. So what goes and comes back counts; what
/// moves on or fades in any one direction does not. Each block counts once for each picture that has both neighbours;
/// blocks at the right and the lower edge are what is left of them there.
class Flicker {
 public:
  static constexpr int kBlock = 16;
  static constexpr double kThreshold = 8.0;

  /// The next picture, of the same size as those before.
  void add(const Picture& picture);

  /// 0 to 1; 0 before the third picture.
  [[nodiscard]] double share() const noexcept;

 private:
  std::array<std::vector<double>, 3> means_;  ///< by block, of the last three pictures, the newest last
  std::size_t pictures_ = 0;
  std::uint64_t jumps_ = 0;
  std::uint64_t blocks_ = 0;  ///< that had both neighbours
};

}  // namespace grove::measure
