#include "objects/lightfield/backend/surroundings/rims.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "models/plants/plants.h"
#include "objects/lightfield/backend/surroundings/rim_kernels.h"

namespace grove::objects::lightfield {
namespace {

using world::Vec2;
using world::Vec3;
using world::Vec4;

constexpr float kApothem = 0.5F * std::numbers::sqrt3_v<float> * models::kTileRadius;

/// Metres by which tiles may be placed inexactly.
constexpr float kTolerance = 0.1F;

/// Wave lengths in metres, and directions in turns: none is a multiple of another.
constexpr std::array<std::pair<float, float>, 6> kWaves{
    {{1.9F, 0.03F}, {1.3F, 0.37F}, {0.83F, 0.71F}, {0.47F, 0.19F}, {0.29F, 0.53F}, {0.17F, 0.91F}}};

Vec2 direction(float turns) {
  const float angle = 2.0F * std::numbers::pi_v<float> * turns;
  return {std::cos(angle), std::sin(angle)};
}

}  // namespace

Rims rimsOf(const world::Object& tile, std::span<const world::Object> objects) {
  const world::Mat4 toWorld = tile.transform.matrix();
  const world::Mat4 toTile = glm::inverse(toWorld);
  Rims rims;
  for (int side = 0; side < 6; ++side) {
    const Vec2 normal = direction((static_cast<float>(side) + 0.5F) / 6.0F);
    const bool hasNeighbour = std::ranges::any_of(objects, [&](const world::Object& other) {
      const Vec3 place(toTile * Vec4(other.transform.position, 1.0F));
      return other.type == tile.type && glm::distance(Vec2(place.x, place.z), 2.0F * kApothem * normal) < kTolerance;
    });
    if (!hasNeighbour) rims.edges.push_back({kApothem * normal, {-normal.y, normal.x}});
  }
  std::ranges::transform(kWaves, rims.waves.begin(), [&](const std::pair<float, float>& wave) {
    const Vec2 inWorld = direction(wave.second) / wave.first;
    const auto along = [&](Vec3 axis) { return glm::dot(inWorld, Vec2(axis.x, axis.z)); };
    return Rims::Wave{{along(Vec3(toWorld[0])), along(Vec3(toWorld[2]))}, along(Vec3(toWorld[3]))};
  });
  return rims;
}

void thinRims(const Rims& rims, const ObjectCamera& camera, raster::Image& image) {
  if (rims.edges.empty()) return;
  thinPart(rims, camera, {image.colour.data(), image.depth.data(), image.width(), image.rect});
  for (std::size_t i = 0; i < image.colour.size(); ++i) {
    if (image.colour[i] == 0) image.depth[i] = world::kInfiniteDepth;
  }
}

}  // namespace grove::objects::lightfield
