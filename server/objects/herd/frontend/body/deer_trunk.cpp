#include <algorithm>
#include <array>
#include <cmath>

#include "objects/herd/frontend/body/deer_parts.h"

namespace grove::objects::herd {
namespace {

using raster::Knot;
using raster::Ring;
using raster::Surface;
using raster::Vertex;
using world::Vec3;

// Outline of the trunk, from the breast (negative) to the rump; metres.
constexpr std::array<Knot, 9> kTop{{{-0.47F, 0.850F},
                                    {-0.40F, 0.905F},
                                    {-0.28F, 0.930F},
                                    {-0.10F, 0.908F},
                                    {0.08F, 0.898F},
                                    {0.24F, 0.915F},
                                    {0.36F, 0.915F},
                                    {0.45F, 0.875F},
                                    {0.51F, 0.795F}}};
constexpr std::array<Knot, 9> kBottom{{{-0.47F, 0.665F},
                                       {-0.40F, 0.570F},
                                       {-0.28F, 0.505F},
                                       {-0.10F, 0.495F},
                                       {0.08F, 0.525F},
                                       {0.24F, 0.590F},
                                       {0.36F, 0.640F},
                                       {0.45F, 0.670F},
                                       {0.51F, 0.725F}}};
constexpr std::array<Knot, 9> kHalfWidth{{{-0.47F, 0.055F},
                                          {-0.40F, 0.092F},
                                          {-0.28F, 0.116F},
                                          {-0.10F, 0.132F},
                                          {0.08F, 0.143F},
                                          {0.24F, 0.136F},
                                          {0.36F, 0.126F},
                                          {0.45F, 0.105F},
                                          {0.51F, 0.050F}}};
constexpr float kRear = 0.53F;
constexpr float kFront = -0.49F;
/// Both halves reach beyond the middle, so that the back stays closed when the spine bends.
constexpr float kOverlap = 0.14F;

constexpr int kHalvings = 3;
/// How much narrower it is below.
constexpr float kKeel = 0.22F;

/// Coat of the trunk at a point: the back is dark, flanks are chestnut, belly and rump are pale.
void paintTrunk(Vertex& vertex, float angle) {
  const Vec3 at = vertex.position;
  const float down = std::cos(angle);  // 1 below, -1 on the back
  Vec3 coat = glm::mix(kChestnut, kDarkCoat, within(down, -1.0F, -0.72F));
  coat = glm::mix(coat, kPaleCoat, within(down, 0.86F, 0.52F));
  // The rump patch has a black edge.
  const float patch = at.z - 0.10F * std::abs(at.y - 0.76F) / 0.12F;
  coat = glm::mix(coat, kBlackCoat, 0.8F * within(patch, 0.415F, 0.385F) * within(down, -0.95F, -0.99F));
  coat = glm::mix(coat, kWhiteCoat, within(patch, 0.455F, 0.425F));
  vertex.albedo = coat;
}

Surface makeTrunk(const Build& build, float rear, float front) {
  return raster::makeTube(
      1, 2,
      [&](float along, float) {
        const float z = glm::mix(rear, front, along);
        const float cap = rounded(along, rear == kRear ? 0.06F : 0.2F, front == kFront ? 0.06F : 0.2F);
        const float top = curve(kTop, z);
        const float bottom = curve(kBottom, z);
        const float deep = 0.5F * (top - bottom) * build.trunk * cap;
        return Ring{{0.0F, 0.5F * (top + bottom), z},
                    {curve(kHalfWidth, z) * build.trunk * cap, 0.0F, 0.0F},
                    {0.0F, deep, 0.0F}};
      },
      [](Vertex& vertex, float, float angle) {
        // The breast is a keel, the back round.
        const float keel = std::max(0.0F, std::cos(angle));
        vertex.position.x *= 1.0F - kKeel * keel;
        paintTrunk(vertex, angle);
      },
      kHalvings);
}

}  // namespace

Vertex skinAt(const Build& build, float z, float angle) {
  const auto at = [&](float atZ, float atAngle) {
    const float top = curve(kTop, atZ);
    const float bottom = curve(kBottom, atZ);
    const float keel = 1.0F - kKeel * std::max(0.0F, std::cos(atAngle));
    return Vec3(curve(kHalfWidth, atZ) * build.trunk * keel * std::sin(atAngle),
                0.5F * (top + bottom) - 0.5F * (top - bottom) * build.trunk * std::cos(atAngle), atZ);
  };
  constexpr float kStep = 0.01F;
  Vertex vertex;
  vertex.position = at(z, angle);
  vertex.normal =
      glm::normalize(glm::cross(at(z, angle + kStep) - vertex.position, at(z - kStep, angle) - vertex.position));
  if (glm::dot(vertex.normal, Vec3(std::sin(angle), -std::cos(angle), 0.0F)) < 0.0F) vertex.normal = -vertex.normal;
  return vertex;
}

Skin skinNear(const Build& build, Vec3 at) {
  const float middle = 0.5F * (curve(kTop, at.z) + curve(kBottom, at.z));
  const float high = 0.5F * (curve(kTop, at.z) - curve(kBottom, at.z)) * build.trunk;
  const float wide = curve(kHalfWidth, at.z) * build.trunk;
  const world::Vec2 off(at.x / wide, (at.y - middle) / high);
  const Vertex skin = skinAt(build, at.z, std::atan2(off.x, -off.y));
  return {skin.normal, (glm::length(off) - 1.0F) * wide};
}

Surface makePelvis(const Build& build) { return makeTrunk(build, kRear, -kOverlap); }

Surface makeChest(const Build& build) { return makeTrunk(build, kOverlap, kFront); }

}  // namespace grove::objects::herd
