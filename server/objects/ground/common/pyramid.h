#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "pipeline/vector_bytes.h"

namespace grove::objects::ground {

/// A mip map: a square picture of four 8-bit channels with all its halved copies. Sizes are powers of two.
class Pyramid {
 public:
  static constexpr int kMaxLevels = 16;
  static constexpr int kBlock = 4;  ///< texels per side of a block of inBlocks()

  /// Averages `finest` (size x size texels) down to a single texel.
  Pyramid(int size, std::vector<std::uint32_t> finest);
  /// All texels are 0.
  explicit Pyramid(int size);

  /// Number of texels in all levels together.
  [[nodiscard]] static std::size_t texelsOf(int size) noexcept;

  [[nodiscard]] int size() const noexcept { return size_; }
  [[nodiscard]] int levels() const noexcept { return static_cast<int>(levels_.size()); }
  /// Level 0 is the finest; level i has size() >> i texels per side, rows without gaps. All levels lie in one array,
  /// finest first.
  [[nodiscard]] const std::uint32_t* level(int index) const noexcept;

  /// Returns a copy whose sufficiently large levels lie in blocks of kBlock x kBlock texels, row by row within a block
  /// and block by block along a row of blocks: a line in any direction touches few cache lines and pages.
  [[nodiscard]] Pyramid inBlocks() const;

  /// The texels of all levels.
  [[nodiscard]] std::span<const std::uint32_t> texels() const noexcept { return texels_; }
  [[nodiscard]] std::span<std::uint32_t> texels() noexcept { return texels_; }

  /// Memory use.
  [[nodiscard]] std::size_t bytes() const noexcept { return pipeline::vectorBytes(texels_, levels_); }

 private:
  int size_;
  std::vector<std::uint32_t> texels_;
  std::vector<std::size_t> levels_;  // first texel of each level
};

/// Packs four channels of 0..1, rounded, into one texel: bytes r, g, b, a in memory.
[[nodiscard]] std::uint32_t packTexel(float r, float g, float b, float a) noexcept;

}  // namespace grove::objects::ground
