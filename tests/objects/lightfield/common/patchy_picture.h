#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <random>
#include <vector>

#include "objects/lightfield/common/picture_part.h"
#include "objects/lightfield/format/view_camera.h"

namespace grove::objects::lightfield {

inline constexpr int kStride = 70;
inline constexpr std::uint32_t kUntouched = 0x12345678U;

inline std::size_t texelAt(int row, int column) {
  return static_cast<std::size_t>(row) * static_cast<std::size_t>(kStride) + static_cast<std::size_t>(column);
}

/// A picture with holes; a part of it begins at its first pixel.
struct PatchyPicture {
  std::vector<std::uint32_t> colour;
  std::vector<float> depth;
  ObjectCamera camera;

  explicit PatchyPicture(const world::Rect& rect) : colour(kStride * 20, kUntouched), depth(kStride * 20, 0.001F) {
    std::mt19937 random(9);
    camera.eye = {0.3F, 1.5F, 4.0F};
    camera.corner = {-0.7F, 0.4F, -1.0F};
    camera.perColumn = {0.02F, 0.001F, 0.0F};
    camera.perRow = {0.001F, -0.02F, 0.002F};
    for (int row = 0; row < rect.height(); ++row) {
      for (int column = 0; column < rect.width(); ++column) {
        const auto at = texelAt(row, column);
        const bool hole = random() % 3 == 0;
        const std::uint32_t alpha = hole ? 0 : 1 + random() % 255;
        colour[at] = alpha << 24U;
        for (std::uint32_t shift = 0; shift < 24; shift += 8) colour[at] |= random() % (alpha + 1) << shift;
        depth[at] = hole ? world::kInfiniteDepth : 1.0F + static_cast<float>(random() % 1000) * 0.005F;
      }
    }
  }

  [[nodiscard]] PicturePart part(const world::Rect& rect) { return {colour.data(), depth.data(), kStride, rect}; }
};

/// Calls expect(pixel before, pixel after, point) for all pixels of the part that show something; the others must be
/// as they were.
template <typename Expect>
void compare(const PatchyPicture& before, const PatchyPicture& after, const world::Rect& rect, const Expect& expect) {
  for (int row = 0; row < 20; ++row) {
    for (int column = 0; column < kStride; ++column) {
      const auto at = texelAt(row, column);
      const bool within = row < rect.height() && column < rect.width();
      if (!within || before.colour[at] == 0) {
        ASSERT_EQ(after.colour[at], before.colour[at]) << column << ", " << row;
        continue;
      }
      const world::Vec3 ray =
          before.camera.ray(static_cast<float>(rect.left + column) + 0.5F, static_cast<float>(rect.top + row) + 0.5F);
      ASSERT_EQ(after.colour[at] >> 24U, before.colour[at] >> 24U);
      expect(before.colour[at], after.colour[at], before.camera.eye + before.depth[at] * ray);
    }
  }
}

inline float channel(std::uint32_t pixel, std::size_t i) { return static_cast<float>(pixel >> (8U * i) & 255U); }

inline const std::array<world::Rect, 4> kRects{world::Rect{5, 3, 6, 4}, world::Rect{0, 0, 16, 8},
                                               world::Rect{7, 1, 24, 20}, world::Rect{2, 2, 69, 9}};

/// Tolerance: half a step for the rounding and a little for where it falls.
inline constexpr float kTolerance = 0.51F;

}  // namespace grove::objects::lightfield
