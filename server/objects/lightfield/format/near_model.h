#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace grove::objects::lightfield {

inline constexpr std::size_t kMaxClusterVertices = 256;
inline constexpr std::size_t kMaxClusterFaces = 256;
/// Clusters begin at multiples of this many vertices, so that vectors of them need no remainder.
inline constexpr std::size_t kClusterAlignment = 16;

/// Faces that are close together, between vertices of their own.
struct NearCluster {
  std::array<float, 3> low{};  ///< bounds, object coordinates
  std::array<float, 3> high{};
  std::uint32_t firstVertex = 0;  ///< a multiple of kClusterAlignment
  std::uint32_t vertices = 0;     ///< at most kMaxClusterVertices
  std::uint32_t firstFace = 0;
  std::uint32_t faces = 0;  ///< at most kMaxClusterFaces
  std::uint32_t firstColour = 0;
  /// 1: a closed surface with a colour per vertex; its backs are never seen. 0: leaves, with a colour per face and
  /// side.
  std::uint32_t smooth = 0;

  [[nodiscard]] std::size_t colours() const noexcept { return smooth != 0 ? vertices : faces; }
};
static_assert(sizeof(NearCluster) == 48, "no padding");

/// Corners within its cluster of a convex, almost flat quadrilateral, counter-clockwise seen from the front. The last
/// two corners of a triangle are the same.
using NearFace = std::array<std::uint8_t, 4>;

/// The lit surface of a light field's object, for eyes so near that texels of the views are larger than pixels.
/// Read-only and shared by all visitors.
struct NearModel {
  std::span<const NearCluster> clusters;
  std::array<std::span<const float>, 3> positions;  ///< by axis: object coordinates of all vertices
  std::span<const NearFace> faces;
  /// By lighting: display-encoded colours of the fronts, then as many of the backs; bytes R, G, B, 255.
  std::vector<std::span<const std::uint32_t>> colours;

  [[nodiscard]] bool empty() const noexcept { return clusters.empty(); }
};

}  // namespace grove::objects::lightfield
