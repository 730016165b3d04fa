#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "world/geometry.h"

namespace grove::raster {

/// A corner of a triangle.
struct Vertex {
  world::Vec3 position{0.0F};  ///< metres, of the object
  float bone = 0.0F;           ///< which of the drawing's matrices moves it
  world::Vec3 normal{0.0F};    ///< unit
  world::Vec3 albedo{0.5F};    ///< linear
  float lichen = 0.0F;         ///< how much of it is overgrown, 0..1
  float emission = 0.0F;       ///< radiance that it gives off, times albedo
  float tint = 0.0F;           ///< share of the drawing's tint
};

using Triangle = std::array<std::uint32_t, 3>;

/// One level of detail: triangles between some of the surface's vertices.
struct Level {
  std::vector<Triangle> triangles;
  float edge = 0.0F;            ///< metres, a typical edge
  std::size_t vertexCount = 0;  ///< none of its corners has this index or a higher one
};

/// A closed, coloured surface. All levels share the vertices of the finest, with the finest's normals, so that light
/// baked per vertex serves them all.
struct Surface {
  std::vector<Vertex> vertices;
  std::vector<Level> levels;  ///< coarse to fine, at least one
  bool weathered = false;     ///< shows the procedural detail of rock

  /// Adds a copy of `other`, moved. Both have the same number of levels, or one of them is empty.
  void append(const Surface& other, const world::Mat4& matrix);

  /// Sets all normals from the finest triangles, weighted by area.
  void computeNormals();

  [[nodiscard]] world::Bounds bounds() const;

  /// Memory that it takes.
  [[nodiscard]] std::size_t bytes() const noexcept;

  /// The finest level alone.
  [[nodiscard]] world::Triangles triangles() const;

  /// The coarsest level whose edges stay short on the screen, for an object at `distance` metres.
  [[nodiscard]] const Level& levelFor(float distance, float focalPixels) const noexcept;
};

/// Puts a vertex where the point of the cube [-1,1]^3's surface belongs.
using Deform = std::function<Vertex(world::Vec3)>;

/// A box of `cells` quads along each axis, every one halved `halvings` times, deformed: `halvings` + 1 levels.
[[nodiscard]] Surface makeDeformedBox(std::array<int, 3> cells, int halvings, const Deform& deform);

}  // namespace grove::raster
