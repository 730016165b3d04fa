#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <vector>

#include "objects/lightfield/bake/light/light_points.h"

namespace grove::bake {

/// The ground y = 0 around an object, which reflects light onto it and lies in its shade: a square of light points.
class Meadow {
 public:
  /// Covers everything around `points`.
  Meadow(const std::vector<LightPoint>& points, world::Vec3 albedo) : albedo_(albedo) {
    world::Bounds bounds;
    for (const LightPoint& point : points) bounds.add(point.position);
    const world::Vec3 size = bounds.empty() ? world::Vec3(1.0F) : bounds.size();
    edge_ = std::max({size.x, size.y, size.z, 1.0e-3F}) * 2.5F;
    if (!bounds.empty()) low_ = bounds.centre() - 0.5F * edge_;
  }

  [[nodiscard]] static std::size_t size() { return std::size_t{kCells} * kCells; }

  [[nodiscard]] LightPoint point(std::size_t index) const {
    const float cell = edge_ / static_cast<float>(kCells);
    const std::size_t row = index / kCells;
    const std::size_t column = index % kCells;
    LightPoint point;
    point.position = {low_.x + (static_cast<float>(column) + 0.5F) * cell, 0.0F,
                      low_.z + (static_cast<float>(row) + 0.5F) * cell};
    point.albedo = albedo_;
    return point;
  }

  /// Index of the light point that a downward ray hits; nothing outside the square.
  [[nodiscard]] std::optional<std::size_t> hit(world::Vec3 origin, world::Vec3 direction) const {
    const float distance = std::max(0.0F, origin.y) / -direction.y;
    const float scale = static_cast<float>(kCells) / edge_;
    const float x = (origin.x + direction.x * distance - low_.x) * scale;
    const float z = (origin.z + direction.z * distance - low_.z) * scale;
    if (!(x >= 0.0F && z >= 0.0F && x < static_cast<float>(kCells) && z < static_cast<float>(kCells))) {
      return std::nullopt;
    }
    return static_cast<std::size_t>(z) * kCells + static_cast<std::size_t>(x);
  }

 private:
  static constexpr std::size_t kCells = 32;

  const world::Vec3 albedo_;
  world::Vec3 low_{0.0F};
  float edge_ = 1.0F;
};

}  // namespace grove::bake
