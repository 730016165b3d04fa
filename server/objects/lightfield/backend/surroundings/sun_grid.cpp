#include "objects/lightfield/backend/surroundings/sun_grid.h"

#include <algorithm>
#include <cmath>

namespace grove::objects::lightfield {
namespace {

using world::Vec3;

constexpr float kFinest = 0.3F;  // metres between samples
constexpr int kMaxCells = 20;    // along an edge
// Objects larger than this are groups of trees that are seen from a distance.
constexpr float kLarge = 12.0F;  // metres
constexpr int kMaxCellsOfLarge = 8;
constexpr int kSunRays = 4;
constexpr float kSunRadius = 0.035F;  // of its direction, same as in the meshes' light

/// Distance from a point inside the box to its surface along a ray.
float exitOf(const world::Bounds& box, Vec3 origin, Vec3 direction) {
  float exit = 1.0e30F;
  for (int axis = 0; axis < 3; ++axis) {
    if (std::abs(direction[axis]) < 1.0e-6F) continue;
    const float side = direction[axis] > 0.0F ? box.high[axis] : box.low[axis];
    exit = std::min(exit, (side - origin[axis]) / direction[axis]);
  }
  return std::max(exit, 0.0F);
}

float sunAt(Vec3 point, Vec3 sun, float from, const world::RayScene& rays) {
  const Vec3 across = glm::normalize(glm::cross(sun, Vec3(0.0F, 1.0F, 0.0F)));
  const Vec3 up = glm::cross(across, sun);
  int seen = 0;
  for (int i = 0; i < kSunRays; ++i) {
    const float radius = kSunRadius * std::sqrt((static_cast<float>(i) + 0.5F) / static_cast<float>(kSunRays));
    const float around = 2.3999632F * static_cast<float>(i);
    const Vec3 direction = sun + radius * (std::cos(around) * across + std::sin(around) * up);
    if (!rays.occluded(point, direction, from)) ++seen;
  }
  return static_cast<float>(seen) / static_cast<float>(kSunRays);
}

}  // namespace

SunGrid makeSunGrid(const world::ModelledObject& object, Vec3 towardsSun, const world::RayScene& rays) {
  const world::Bounds box = object.model->bounds();
  const world::Mat4 toWorld = object.transform.matrix();
  const Vec3 perMetre = glm::inverse(glm::mat3(toWorld)) * towardsSun;
  const Vec3 sun = glm::normalize(perMetre);
  // A leaning object is stretched along some directions.
  const float stretch = 1.0F / glm::length(perMetre);
  SunGrid grid;
  grid.low = box.low;
  const Vec3 extent = box.size() * object.transform.scale;
  const bool isLarge = std::max({extent.x, extent.y, extent.z}) > kLarge;
  for (int axis = 0; axis < 3; ++axis) {
    const float size = std::max(box.size()[axis], 1.0e-3F);
    const int cells =
        std::clamp(static_cast<int>(std::ceil(extent[axis] / kFinest)) + 1, 2, isLarge ? kMaxCellsOfLarge : kMaxCells);
    grid.cells[static_cast<std::size_t>(axis)] = cells;
    grid.perMetre[axis] = static_cast<float>(cells - 1) / size;
  }
  for (int z = 0; z < grid.cells[2]; ++z) {
    for (int y = 0; y < grid.cells[1]; ++y) {
      for (int x = 0; x < grid.cells[0]; ++x) {
        const Vec3 sample(static_cast<float>(x), static_cast<float>(y), static_cast<float>(z));
        const Vec3 point = box.low + sample / grid.perMetre;
        const float from = exitOf(box, point, sun) * stretch;
        grid.sun.push_back(sunAt(Vec3(toWorld * world::Vec4(point, 1.0F)), towardsSun, from, rays));
      }
    }
  }
  grid.whole = std::ranges::all_of(grid.sun, [](float share) { return share == 1.0F; });
  return grid;
}

}  // namespace grove::objects::lightfield
