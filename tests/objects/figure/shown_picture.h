#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <variant>
#include <vector>

#include "node/messages.h"
#include "raster/image.h"

namespace grove::objects::figure {

/// A picture where its spans leave nothing out.
struct Picture {
  explicit Picture(const node::Payload& payload) : Picture(*std::get<std::shared_ptr<const raster::Image>>(payload)) {}

  explicit Picture(const raster::Image& image) : rect(image.rect) {
    colour.resize(image.colour.size());
    depth.resize(image.depth.size(), world::kInfiniteDepth);
    for (int row = 0; row < image.height(); ++row) {
      const raster::Span span = image.span(row);
      for (int x = span.begin; x < span.end; ++x) {
        const std::size_t to = at(rect.left + x, rect.top + row);
        colour[to] = image.colourRow(row)[x];
        depth[to] = image.depthRow(row)[x];
      }
    }
  }

  /// Index of a pixel of the camera's image.
  [[nodiscard]] std::size_t at(int x, int y) const {
    return static_cast<std::size_t>(y - rect.top) * static_cast<std::size_t>(rect.width()) +
           static_cast<std::size_t>(x - rect.left);
  }

  /// Opacity of the pixel at a point that was projected; 0 beyond the picture.
  [[nodiscard]] float shadeAt(world::Vec3 projected) const {
    const auto x = static_cast<int>(std::floor(projected.x));
    const auto y = static_cast<int>(std::floor(projected.y));
    if (x < rect.left || x >= rect.right || y < rect.top || y >= rect.bottom) return 0.0F;
    return static_cast<float>(colour[at(x, y)] >> 24U) / 255.0F;
  }

  world::Rect rect;
  std::vector<std::uint32_t> colour;
  std::vector<float> depth;
};

/// Whether a pixel darkens what is behind: of the figure's outline, the least covered pixels are as dark.
[[nodiscard]] inline bool isShade(std::uint32_t colour) {
  const std::uint32_t opacity = colour >> 24U;
  const auto isDark = [&](unsigned shift) { return (colour >> shift & 0xFFU) * 4 < opacity; };
  return opacity > 8 && opacity < 255 && isDark(0) && isDark(8) && isDark(16);
}

/// Pixels that show the figure as a whole, and those of its shadow.
[[nodiscard]] inline std::pair<std::size_t, std::size_t> solidAndShade(const Picture& image) {
  std::pair<std::size_t, std::size_t> counts;
  for (std::size_t i = 0; i < image.depth.size(); ++i) {
    if (image.depth[i] >= world::kInfiniteDepth) continue;
    if (image.colour[i] >> 24U == 0xFFU) ++counts.first;
    if (isShade(image.colour[i])) ++counts.second;
  }
  return counts;
}

}  // namespace grove::objects::figure
