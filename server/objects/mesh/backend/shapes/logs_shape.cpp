#include <cmath>

#include "objects/mesh/backend/shapes/rock.h"
#include "objects/mesh/backend/shapes/shapes.h"
#include "raster/shading/noise.h"

namespace grove::objects::mesh {
namespace {

using world::Vec3;

constexpr int kLogHalvings = 2;

/// A charred log along y from 0 to `length`, burnt to embers towards its upper end.
raster::Surface makeLog(float length, float radius, std::uint32_t seed) {
  const Vec3 offset(raster::random01(seed, 1) * 90.0F, raster::random01(seed, 2) * 90.0F,
                    raster::random01(seed, 3) * 90.0F);
  return raster::makeDeformedBox({1, 3, 1}, kLogHalvings, [&](Vec3 cube) {
    const float along = 0.5F * (cube.y + 1.0F);
    const float square = std::max(std::abs(cube.x), std::abs(cube.z));
    const float circle = std::hypot(cube.x, cube.z);
    const Vec3 round = circle > 0.0F ? cube * (square / circle) : cube;
    const Vec3 p(round.x, along * length, round.z);
    const Vec3 q = Vec3(p.x * 2.2F, p.y * 5.0F, p.z * 2.2F) + offset;
    const float bark = raster::fractalNoise(q, 3);
    const float checked = std::abs(raster::fractalNoise(Vec3(p.x * 3.0F, p.y * 40.0F, p.z * 3.0F) + offset, 2));
    const float wide = radius * (1.0F - 0.25F * along) * (1.0F + 0.35F * bark - 0.25F * checked);
    raster::Vertex vertex;
    vertex.position = Vec3(p.x * wide, p.y + 0.03F * bark, p.z * wide);
    const float burnt = glm::clamp(2.2F * along - 0.2F + 0.6F * bark, 0.0F, 1.0F);
    vertex.albedo = glm::mix(Vec3(0.19F, 0.12F, 0.07F), Vec3(0.025F, 0.022F, 0.021F), burnt);
    // The fire is hottest where the logs lean on each other.
    const float ember = glm::clamp((along - 0.55F) * 3.0F, 0.0F, 1.0F) * glm::clamp(5.0F * bark - 0.2F, 0.0F, 1.0F);
    if (ember > 0.0F) {
      vertex.albedo = glm::mix(vertex.albedo, Vec3(1.0F, 0.26F, 0.04F), ember);
      vertex.emission = 1.6F * ember;
    }
    return vertex;
  });
}

}  // namespace

raster::Surface makeLogs(const Size& size, std::uint32_t seed) {
  constexpr std::uint32_t kLogs = 7;
  constexpr std::uint32_t kStones = 11;
  raster::Surface fire;
  for (std::uint32_t i = 0; i < kLogs; ++i) {
    const auto random = [&](std::uint32_t k) { return raster::random01(seed, 300 + 16 * i + k); };
    const float around = 6.2832F * (static_cast<float>(i) + 0.4F * random(0)) / static_cast<float>(kLogs);
    const float foot = 0.34F * size.width;
    const float length = std::hypot(foot, size.height) * (0.95F + 0.3F * random(1));
    const float tilt = std::atan2(foot, size.height * (0.65F + 0.45F * random(2)));
    world::Mat4 placed = glm::rotate(world::Mat4(1.0F), around, Vec3(0, 1, 0));
    placed = glm::translate(placed, Vec3(foot, -0.02F, 0.10F * size.width * (random(3) - 0.5F)));
    placed = glm::rotate(placed, tilt, Vec3(0, 0, 1));
    fire.append(makeLog(length, 0.055F * size.width * (0.8F + 0.4F * random(4)), seed * 37U + i), placed);
  }
  for (std::uint32_t i = 0; i < kStones; ++i) {
    const auto random = [&](std::uint32_t k) { return raster::random01(seed, 600 + 16 * i + k); };
    RockForm form;
    form.half = Vec3(0.085F + 0.03F * random(0), 0.06F + 0.025F * random(1), 0.07F + 0.02F * random(2)) * size.width;
    form.roundness = 2.5F;
    form.buried = 0.3F * form.half.y;
    form.seed = seed * 41U + i;
    const float around = 6.2832F * (static_cast<float>(i) + 0.2F * random(3)) / static_cast<float>(kStones);
    world::Mat4 placed = glm::rotate(world::Mat4(1.0F), around, Vec3(0, 1, 0));
    placed = glm::translate(placed, Vec3(0.41F * size.width, form.half.y - form.buried, 0.0F));
    placed = glm::rotate(placed, 1.2F * (random(4) - 0.5F) + 1.5708F, Vec3(0, 1, 0));
    fire.append(makeRock(form, 2.0F * form.half.x, kLogHalvings), placed);
  }
  // Soot.
  for (raster::Vertex& vertex : fire.vertices) {
    const float out = std::hypot(vertex.position.x, vertex.position.z) / size.width;
    vertex.albedo *= 0.45F + 0.55F * glm::smoothstep(0.28F, 0.46F, out);
    vertex.lichen = 0.0F;
  }
  return fire;
}

}  // namespace grove::objects::mesh
