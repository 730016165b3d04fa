#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "raster/shading/detail.h"
#include "raster/vertex_arrays.h"

namespace grove::raster {

/// A vertex before the division by its view depth: pixels times depth, and what is interpolated, all linear in space.
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
  /// Near depth / view depth, and the shade times that: all of them linear on the screen.
  std::array<float, 6> planes;
};

/// Vertices are put on this grid, so that differences of coordinates are exact.
inline constexpr float kSubPixel = 1.0F / 256.0F;

/// Relief (0..15) of a unit of lightVertices()'s A.
inline constexpr float kReliefOfByte = 15.0F / 255.0F;

// Both the kernels and the clipping make corners, which must agree where they meet.

inline float onGrid(float pixels) { return std::floor(pixels * (1.0F / kSubPixel) + 0.5F) * kSubPixel; }

/// Through a signed number, which vectors convert at once.
inline float byteOf(std::uint32_t packed, unsigned shift) {
  return static_cast<float>(static_cast<std::int32_t>((packed >> shift) & 0xFFU));
}

/// The vertices of one drawing. Reused from drawing to drawing, so that none allocates.
struct ScreenVertices {
  std::vector<float> u, v, depth;
  std::vector<std::uint32_t> light;  ///< as of lightVertices()
  std::vector<Corner> corners;       ///< only those beyond the near depth mean anything
  float nearest = 0.0F;              ///< least depth of all

  /// Memory that they take.
  [[nodiscard]] std::size_t bytes() const noexcept { return pipeline::vectorBytes(u, v, depth, light, corners); }

  [[nodiscard]] ClipVertex clipVertex(std::size_t index, float lichen) const noexcept;
};

/// What triangles are drawn to: fragments as detail.h finishes them, in rows with room beyond their end.
struct Canvas {
  world::Rect rect;
  std::ptrdiff_t stride = 0;  ///< pixels
  std::vector<std::uint32_t> surface;
  std::vector<float> depth;  ///< near depth / view depth, 0 where nothing is
  std::vector<Span> spans;   ///< by row, the columns from the left that have been drawn to

  /// Memory that it takes.
  [[nodiscard]] std::size_t bytes() const noexcept { return pipeline::vectorBytes(surface, depth, spans); }

  /// Empties it for another rectangle; only what was drawn to costs anything.
  void begin(const world::Rect& to);
};

/// Fills `vertices` with the first `light.size()` of the drawing, which vertices.light must hold the light of.
void project(const VertexArrays& arrays, const Drawing& drawing, ScreenVertices& vertices);

/// A clipped vertex, whose depth is at least the near depth.
[[nodiscard]] Corner projected(const ClipVertex& vertex, float nearDepth) noexcept;

}  // namespace grove::raster
