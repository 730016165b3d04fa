#include "raster/shading/light_bake.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/gtc/matrix_inverse.hpp>

#include "world/camera.h"

namespace grove::raster {
namespace {

using world::Vec3;
using world::Vec4;

constexpr std::uint32_t kSunRays = 8;
constexpr std::uint32_t kSkyRays = 64;
constexpr float kSunRadius = 0.035F;  // of its direction: wider than the real sun, as through haze
constexpr float kAway = 0.015F;       // metres, offset of ray origins from the surface against self-intersection
constexpr float kReach = 15.0F;       // metres beyond which nothing occludes the sky
constexpr float kContact = 0.6F;      // metres below which the object itself shades the ground
const Vec3 kRockBounce{0.075F, 0.062F, 0.048F};

/// Second coordinate of the Hammersley points.
float radicalInverse(std::uint32_t bits) {
  bits = (bits << 16U) | (bits >> 16U);
  bits = ((bits & 0x55555555U) << 1U) | ((bits & 0xAAAAAAAAU) >> 1U);
  bits = ((bits & 0x33333333U) << 2U) | ((bits & 0xCCCCCCCCU) >> 2U);
  bits = ((bits & 0x0F0F0F0FU) << 4U) | ((bits & 0xF0F0F0F0U) >> 4U);
  bits = ((bits & 0x00FF00FFU) << 8U) | ((bits & 0xFF00FF00U) >> 8U);
  return static_cast<float>(bits) * 2.3283064e-10F;
}

using SkyDirections = std::array<Vec3, kSkyRays>;
using SunDirections = std::array<Vec3, kSunRays>;

/// Cosine-weighted around +z.
SkyDirections skyDirections() {
  SkyDirections directions;
  for (std::uint32_t i = 0; i < kSkyRays; ++i) {
    const float u = (static_cast<float>(i) + 0.5F) / static_cast<float>(kSkyRays);
    const float around = 6.2831853F * radicalInverse(i);
    const float radius = std::sqrt(u);
    directions[i] = {radius * std::cos(around), radius * std::sin(around), std::sqrt(std::max(0.0F, 1.0F - u))};
  }
  return directions;
}

/// A spiral over the sun's disc.
SunDirections sunDirections(Vec3 sun) {
  SunDirections directions;
  const glm::mat3 basis = world::basisAround(sun);
  for (std::uint32_t i = 0; i < kSunRays; ++i) {
    const float radius = kSunRadius * std::sqrt((static_cast<float>(i) + 0.5F) / static_cast<float>(kSunRays));
    const float around = 2.3999632F * static_cast<float>(i);
    directions[i] = basis * Vec3(radius * std::cos(around), radius * std::sin(around), 1.0F);
  }
  return directions;
}

bool occluded(const Obstacles& obstacles, Vec3 origin, Vec3 direction, float reach) {
  return obstacles.world.occluded(origin, direction, 0.0F, reach) ||
         (obstacles.own != nullptr && obstacles.own->occluded(origin, direction, 0.0F, reach));
}

float sunAt(Vec3 point, const Obstacles& obstacles, const SunDirections& directions) {
  const auto seen = std::ranges::count_if(
      directions, [&](Vec3 direction) { return !occluded(obstacles, point, direction, world::kInfiniteDepth); });
  return static_cast<float>(seen) / static_cast<float>(kSunRays);
}

/// Indirect light above ground of this height, weakened by the sky's occlusion and coloured by the open directions.
Vec3 indirectAt(Vec3 origin, Vec3 normal, float ground, const world::Sky& sky, const Obstacles& obstacles,
                const SkyDirections& directions) {
  const glm::mat3 basis = world::basisAround(normal);
  float open = 0.0F;
  Vec3 openSide(0.0F);
  for (const Vec3 around : directions) {
    const Vec3 direction = basis * around;
    float reach = kReach;
    float share = 1.0F;
    if (direction.y < 0.0F) {
      const float toGround = (origin.y - ground) / -direction.y;
      reach = std::min(reach, toGround);
      share = 0.35F + 0.65F * std::min(1.0F, toGround / kContact);
    }
    if (occluded(obstacles, origin, direction, reach)) continue;
    open += share;
    openSide += direction * share;
  }
  open /= static_cast<float>(kSkyRays);
  const float length = glm::length(openSide);
  const Vec3 towards = length > 0.0F ? openSide / length : normal;
  return sky.ambient(towards) * open + kRockBounce * (1.0F - open);
}

}  // namespace

float sunAt(Vec3 point, Vec3 sun, const world::RayScene& solids) {
  return sunAt(point, Obstacles{solids}, sunDirections(sun));
}

void bakeLight(const Surface& surface, const world::Mat4& toWorld, const world::Sky& sky, const Obstacles& obstacles,
               std::size_t begin, std::span<Vec4> light) {
  const SkyDirections around = skyDirections();
  const SunDirections sun = sunDirections(sky.sun);
  const glm::mat3 turn = glm::inverseTranspose(glm::mat3(toWorld));
  for (std::size_t i = 0; i < light.size(); ++i) {
    const Vertex& vertex = surface.vertices[begin + i];
    const Vec3 normal = glm::normalize(turn * vertex.normal);
    Vec3 origin = Vec3(toWorld * Vec4(vertex.position, 1.0F)) + normal * kAway;
    // Triangles that cross the ground use the light of their vertices below it.
    const float ground = world::groundHeight(obstacles.hills, {origin.x, origin.z});
    origin.y = std::max(origin.y, ground + 2.0F * kAway);
    const bool towardsSun = glm::dot(normal, sky.sun) > -0.2F;
    light[i] = Vec4(towardsSun ? sunAt(origin, obstacles, sun) : 0.0F,
                    indirectAt(origin, normal, ground, sky, obstacles, around));
  }
}

}  // namespace grove::raster
