#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace grove::objects::lightfield {

/// Samples of a pixel, a bit each: no two have the same row or column of a grid of 16 x 16.
inline constexpr int kPixelSamples = 16;

/// Coverage masks of half-planes: the samples of a pixel on one side of a line, by the line's slope and its distance
/// from the pixel's centre (Carpenter 1984, "The A-buffer, an antialiased hidden surface method"). The masks of a
/// line's two sides are complements, so faces with a common edge leave no gaps. Read-only.
class HalfPlanes {
 public:
  static constexpr int kSlopes = 33;  ///< of normals (x, y) with y >= 0, by x / (|x| + y) from -1 to 1
  static constexpr int kDistances = 16;
  static constexpr float kDistanceStep = 0.09F;  ///< pixels

  /// By distance: the low and the high bytes of the samples' bits.
  struct Masks {
    alignas(16) std::array<std::uint8_t, kDistances> low;
    alignas(16) std::array<std::uint8_t, kDistances> high;
  };

  HalfPlanes();

  /// `line`: the normal's slope, whose side has the samples, or slope + kSlopes for the others. Entry i is for centres
  /// whose distance from the line, in the normal's direction, is from kDistanceStep * (i - kDistances / 2) on.
  [[nodiscard]] const Masks& at(std::int32_t line) const noexcept { return masks_[static_cast<std::size_t>(line)]; }

 private:
  std::array<Masks, std::size_t{2} * kSlopes> masks_;
};

}  // namespace grove::objects::lightfield
