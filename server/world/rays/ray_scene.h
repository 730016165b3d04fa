#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>

#include "world/geometry.h"

namespace grove::world {

/// Triangles that stand at a place. Several places may share them.
struct PlacedTriangles {
  std::shared_ptr<const Triangles> triangles;
  Mat4 toWorld{1.0F};
};

/// Triangles for ray tracing (Embree). Immutable after construction; any number of threads may trace.
class RayScene {
 public:
  /// Whether rays hit the backs of triangles, from which their corners appear clockwise. Shadow rays always do.
  enum class Backs : std::uint8_t { kMet, kPassed };

  /// Calls `progress` with shares of 0..1 during construction, from any thread, one at a time; its exceptions abort the
  /// construction.
  explicit RayScene(const Triangles& triangles, const std::function<void(float)>& progress = {},
                    Backs backs = Backs::kMet);
  /// The same of triangles at their places; keeps one copy of those that several places share.
  explicit RayScene(std::span<const PlacedTriangles> placed, const std::function<void(float)>& progress = {});
  ~RayScene();
  RayScene(RayScene&&) noexcept;
  RayScene& operator=(RayScene&&) noexcept;

  struct Hit {
    float distance = 0.0F;       ///< in lengths of the direction
    std::uint32_t triangle = 0;  ///< of those at its place
    float u = 0.0F;              ///< barycentric: point = (1-u-v)*a + u*b + v*c
    float v = 0.0F;
    Vec3 normal{0.0F};  ///< geometric, unit
  };

  [[nodiscard]] std::optional<Hit> intersect(Vec3 origin, Vec3 direction, float near = 0.0F, float far = 1.0e30F) const;
  /// Embree's memory for it.
  [[nodiscard]] std::size_t bytes() const noexcept;

  [[nodiscard]] bool occluded(Vec3 origin, Vec3 direction, float near = 0.0F, float far = 1.0e30F) const;

 private:
  struct Handles;
  std::unique_ptr<Handles> handles_;
};

}  // namespace grove::world
