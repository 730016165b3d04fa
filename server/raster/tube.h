#pragma once

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <iterator>

#include "raster/surface.h"

/// Closed tubes, of which bodies are built.
namespace grove::raster {

/// A value at a place along a tube. Values between knots are interpolated smoothly.
struct Knot {
  float along = 0.0F;
  float value = 0.0F;
};

/// `knots` are sorted by place, at least one.
[[nodiscard]] inline float profile(std::initializer_list<Knot> knots, float along) {
  const auto* const next = std::ranges::find_if(knots, [&](const Knot& knot) { return knot.along >= along; });
  if (next == knots.begin()) return next->value;
  if (next == knots.end()) return std::prev(next)->value;
  const Knot& last = *std::prev(next);
  return glm::mix(last.value, next->value, glm::smoothstep(last.along, next->along, along));
}

/// A cross-section of a tube: its half axes to the right and to the back.
struct Ring {
  world::Vec3 centre{0.0F};
  world::Vec3 right{0.1F, 0.0F, 0.0F};
  world::Vec3 back{0.0F, 0.0F, 0.1F};
};

/// A horizontal cross-section.
[[nodiscard]] inline Ring levelRing(world::Vec3 centre, float radiusX, float radiusZ) {
  return {centre, {radiusX, 0.0F, 0.0F}, {0.0F, 0.0F, radiusZ}};
}

/// A cross-section perpendicular to a limb with the direction `way`, which is not sideways.
[[nodiscard]] inline Ring squareRing(world::Vec3 centre, world::Vec3 way, float radius) {
  const world::Vec3 back = glm::normalize(glm::cross(world::Vec3(1, 0, 0), way));
  const world::Vec3 right = glm::normalize(glm::cross(way, back));
  return {centre, right * radius, back * radius};
}

/// Makes a closed tube with `halvings` + 1 levels of detail. `ring` and `paint` get a share 0..1 of the length and an
/// angle, 0 in front and positive to the right. The coarsest level has 8 `around` corners around it.
template <class RingAt, class Paint>
[[nodiscard]] Surface makeTube(int around, int segments, const RingAt& ring, const Paint& paint, int halvings = 2) {
  return makeDeformedBox({around, segments, around}, halvings, [&](world::Vec3 cube) {
    const float along = 0.5F * (cube.y + 1.0F);
    const float angle = std::atan2(cube.x, -cube.z);
    const float square = std::max(std::abs(cube.x), std::abs(cube.z));
    const float circle = std::hypot(cube.x, cube.z);
    const float out = circle > 0.0F ? square / circle : 0.0F;
    const Ring at = ring(along, angle);
    Vertex vertex;
    vertex.position = at.centre + out * (cube.x * at.right + cube.z * at.back);
    paint(vertex, along, angle);
    return vertex;
  });
}

}  // namespace grove::raster
