#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>
#include <vector>

#include "pipeline/vector_bytes.h"

namespace grove::world {

/// Metres, right-handed, Y up.
using Vec2 = glm::vec2;
using Vec3 = glm::vec3;
using Vec4 = glm::vec4;
using Mat4 = glm::mat4;

/// Axis-aligned box in metres; empty until something is added.
struct Bounds {
  Vec3 low{std::numeric_limits<float>::infinity()};
  Vec3 high{-std::numeric_limits<float>::infinity()};

  [[nodiscard]] bool empty() const noexcept { return low.x > high.x; }
  [[nodiscard]] Vec3 centre() const noexcept { return (low + high) * 0.5F; }
  [[nodiscard]] Vec3 size() const noexcept { return high - low; }
  [[nodiscard]] std::array<Vec3, 8> corners() const noexcept;
  /// Distance of a point; 0 inside.
  [[nodiscard]] float distance(Vec3 point) const noexcept { return glm::distance(point, glm::clamp(point, low, high)); }
  void add(Vec3 point) noexcept;
  void add(const Bounds& other) noexcept;
};

/// Placement of an object: scaled uniformly, rotated about Y, and sheared, so that it lies on a slope and what is
/// upright stays upright.
struct Transform {
  Vec3 position{0.0F};
  float yaw = 0.0F;  ///< radians, counter-clockwise seen from above
  float scale = 1.0F;
  Vec2 slope{0.0F};  ///< of the ground, along the world's x and z

  [[nodiscard]] Mat4 matrix() const;
  [[nodiscard]] Bounds apply(const Bounds& bounds) const;
};

/// Indexed triangles in metres. Must be closed for voxelising.
struct Triangles {
  std::vector<Vec3> positions;
  std::vector<std::array<std::uint32_t, 3>> indices;

  void append(const Triangles& other, const Mat4& matrix);
  [[nodiscard]] Bounds bounds() const;
  /// Memory use.
  [[nodiscard]] std::size_t bytes() const noexcept { return pipeline::vectorBytes(positions, indices); }
};

/// Orthonormal basis with the unit vector as its last column (Duff et al. 2017, "Building an Orthonormal Basis,
/// Revisited").
[[nodiscard]] glm::mat3 basisAround(Vec3 direction) noexcept;

}  // namespace grove::world
