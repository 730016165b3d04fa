#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "objects/lightfield/backend/near/half_planes.h"
#include "objects/lightfield/backend/near/near_tiles.h"
#include "pipeline/vector_bytes.h"

namespace grove::objects::lightfield {

/// 8 x 2 pixels, row by row. Faces come front to back: each sample belongs to the first that covers it.
struct alignas(32) NearPixels {
  static constexpr int kColumns = 8;
  static constexpr int kRows = 2;
  static constexpr std::size_t kCount = std::size_t{kColumns} * kRows;

  std::uint16_t covered[kCount];    ///< a bit per sample
  std::int16_t nearness[kCount];    ///< of the nearest face in units of kNearnessUnit, 0 if there is none
  std::uint16_t colour[3][kCount];  ///< sums of the covered samples'
};

/// The pixels of a tile.
struct NearCanvas {
  static constexpr int kAcross = kNearTile / NearPixels::kColumns;
  static constexpr int kDown = kNearTile / NearPixels::kRows;
  static constexpr int kBlock = kNearBlock / NearPixels::kRows;  ///< NearPixels below each other

  std::vector<NearPixels> pixels = std::vector<NearPixels>(std::size_t{kAcross} * kDown);
  std::array<std::uint8_t, 64> fullCount{};  ///< by block, row by row: NearPixels whose samples are all covered
  std::array<std::int16_t, 64> farthest{};   ///< by block: least nearness if it is full, else 0

  /// The index of a block.
  [[nodiscard]] static std::size_t block(int column, int row) {
    return static_cast<std::size_t>(row) * kTileBlocks + static_cast<std::size_t>(column);
  }
  [[nodiscard]] NearPixels* row(int i) { return pixels.data() + std::ptrdiff_t{i} * kAcross; }
  void clear() {
    std::ranges::fill(pixels, NearPixels{});
    fullCount.fill(0);
    farthest.fill(0);
  }

  /// Memory use.
  [[nodiscard]] std::size_t bytes() const noexcept { return pipeline::vectorBytes(pixels); }
};

}  // namespace grove::objects::lightfield
