#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "stream/encode/h264/macroblock_pixels.h"

namespace grove::stream::h264 {

/// Knows which macroblocks need not be looked at: where neither the source nor the reference has changed since it was
/// found that no residual is worth its bits.
class StillMacroblocks {
 public:
  StillMacroblocks() = default;
  StillMacroblocks(int across, int down);

  /// Nothing is still in an independent picture, or right after it.
  void nextPicture(bool independent);
  /// Whether the last picture shows the macroblock as the one before it, and would show this source the same way.
  /// `quantiser`: a finer one than before may show more.
  [[nodiscard]] bool isStill(const MacroblockPixels& source, int quantiser, int column, int row) const;

  /// The macroblock was skipped, and repeats that of the last picture.
  void keep(const MacroblockPixels& source, int quantiser, int column, int row);
  /// The macroblock was not. It changes its neighbours, too: their edges are filtered.
  void change(int column, int row);

  [[nodiscard]] std::size_t bytes() const noexcept { return states_.capacity() * sizeof(State); }

 private:
  struct State {
    std::uint64_t checksum = 0;  ///< of the source
    std::uint32_t changed = 0;   ///< number of the last picture in which it, or a neighbour, was not kept
    int quantiser = 0;
  };
  [[nodiscard]] std::size_t index(int column, int row) const;

  int across_ = 0;
  int down_ = 0;
  std::uint32_t picture_ = 0;
  std::vector<State> states_;
};

}  // namespace grove::stream::h264
