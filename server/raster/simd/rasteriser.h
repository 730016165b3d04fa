#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "raster/shading/detail.h"
#include "raster/vertex_arrays.h"

namespace grove::raster {

/// A vertex before the division by its view depth: pixels times depth and the interpolated values, all linear in space.
struct ClipVertex {
  float u;
  float v;
  float depth;
  std::array<float, 5> shade;  ///< red, green, blue (0..255), relief, lichen (0..15)
};

/// A vertex on the screen.
struct Corner {
  float x;  ///< pixels of the frame, in steps of kSubPixel
  float y;
  /// Near depth / view depth, and the shade times that: all linear on the screen.
  std::array<float, 6> planes;
};

/// Vertices are snapped to this grid, so that differences of coordinates are exact.
inline constexpr float kSubPixel = 1.0F / 256.0F;

/// Relief (0..15) per unit of lightVertices()'s A.
inline constexpr float kReliefOfByte = 15.0F / 255.0F;

// Kernels and clipping both make corners, which must agree where they meet.

inline float onGrid(float pixels) { return std::floor(pixels * (1.0F / kSubPixel) + 0.5F) * kSubPixel; }

/// Converts through a signed number, which vectors convert in one instruction.
inline float byteOf(std::uint32_t packed, unsigned shift) {
  return static_cast<float>(static_cast<std::int32_t>((packed >> shift) & 0xFFU));
}

/// The vertices of one drawing. Reused across drawings, so that none allocates.
struct ScreenVertices {
  std::vector<float> u, v, depth;
  std::vector<std::uint32_t> light;  ///< from lightVertices()
  std::vector<Corner> corners;       ///< valid only beyond the near depth
  float nearest = 0.0F;              ///< least depth of all

  /// Memory use.
  [[nodiscard]] std::size_t bytes() const noexcept { return pipeline::vectorBytes(u, v, depth, light, corners); }

  [[nodiscard]] ClipVertex clipVertex(std::size_t index, float lichen) const noexcept;
};

/// The render target of triangles: fragments for detail.h, in rows with room beyond their end.
struct Canvas {
  world::Rect rect;
  std::ptrdiff_t stride = 0;  ///< pixels
  std::vector<std::uint32_t> surface;
  std::vector<float> depth;  ///< near depth / view depth, 0 if empty
  std::vector<Span> spans;   ///< per row, the touched columns from the left

  /// Memory use.
  [[nodiscard]] std::size_t bytes() const noexcept { return pipeline::vectorBytes(surface, depth, spans); }

  /// Clears it for another rectangle; costs only the touched pixels.
  void begin(const world::Rect& to);
};

/// Fills the first `light.size()` of the drawing's vertices; vertices.light must hold their light.
void project(const VertexArrays& arrays, const Drawing& drawing, ScreenVertices& vertices);

/// A clipped vertex; its depth is at least the near depth.
[[nodiscard]] Corner projected(const ClipVertex& vertex, float nearDepth) noexcept;

}  // namespace grove::raster
