#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "world/geometry.h"

namespace grove::raster {

/// A corner of a triangle.
struct Vertex {
  world::Vec3 position{0.0F};  ///< metres, object coordinates
  float bone = 0.0F;           ///< index into the drawing's matrices
  world::Vec3 normal{0.0F};    ///< unit
  world::Vec3 albedo{0.5F};    ///< linear
  float lichen = 0.0F;         ///< share that is overgrown, 0..1
  float emission = 0.0F;       ///< emitted radiance, relative to albedo
  float tint = 0.0F;           ///< share of the drawing's tint
};

using Triangle = std::array<std::uint32_t, 3>;

/// One level of detail: triangles between some of the surface's vertices.
struct Level {
  std::vector<Triangle> triangles;
  float error = 0.0F;           ///< metres, root mean square distance from the finest level
  std::size_t vertexCount = 0;  ///< all of its corners have smaller indices
};

/// A closed, coloured surface. All levels share the vertices and normals of the finest, so that light baked per vertex
/// serves them all.
struct Surface {
  std::vector<Vertex> vertices;
  std::vector<Level> levels;  ///< coarse to fine, at least one
  bool weathered = false;     ///< has the procedural detail of rock
  bool marked = false;        ///< has open parts that lie on closed ones; their edges are not part of its outline
  float gloss = 0.0F;         ///< how much of sun and surroundings it mirrors: 0 dull, 1 as moist stone

  /// Adds a transformed copy of `other`. Both have the same number of levels, or one of them is empty.
  void append(const Surface& other, const world::Mat4& matrix);

  /// Reorders the vertices so that a coarse level uses the first ones only, as the levels of a part that was appended
  /// do not. Returns for each vertex the index that it had.
  std::vector<std::uint32_t> putCoarseFirst();

  /// Computes all normals from the finest triangles, weighted by area.
  void computeNormals();

  [[nodiscard]] world::Bounds bounds() const;

  /// Memory use.
  [[nodiscard]] std::size_t bytes() const noexcept;

  /// The surface with the finest level only.
  [[nodiscard]] world::Triangles triangles() const;

  /// The coarsest level that hardly differs from the finest on the screen, for an object at `distance` metres.
  [[nodiscard]] const Level& levelFor(float distance, float focalPixels) const noexcept;
};

/// Maps a point on the surface of the cube [-1,1]^3 to a vertex.
using Deform = std::function<Vertex(world::Vec3)>;

/// A deformed box of `cells` quads along each axis, each halved `halvings` times: `halvings` + 1 levels.
[[nodiscard]] Surface makeDeformedBox(std::array<int, 3> cells, int halvings, const Deform& deform);

}  // namespace grove::raster
