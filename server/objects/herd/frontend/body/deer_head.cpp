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

const Vec3 kNeckEnd = kNeckRoot - Vec3(0.0F, 0.0F, kLowerNeckLength + kUpperNeckLength);
const Vec3 kEyeBlack{0.008F, 0.006F, 0.005F};
const Vec3 kNose{0.018F, 0.014F, 0.013F};

// Metres ahead of the neck's end.
constexpr float kSkullBack = -0.055F;
constexpr std::array<Knot, 8> kBrow{{{-0.055F, 0.030F},
                                     {-0.02F, 0.062F},
                                     {0.03F, 0.075F},
                                     {0.08F, 0.064F},
                                     {0.13F, 0.042F},
                                     {0.19F, 0.020F},
                                     {0.235F, 0.008F},
                                     {0.265F, 0.000F}}};
constexpr std::array<Knot, 8> kJaw{{{-0.055F, -0.030F},
                                    {-0.02F, -0.054F},
                                    {0.03F, -0.062F},
                                    {0.08F, -0.058F},
                                    {0.13F, -0.050F},
                                    {0.19F, -0.044F},
                                    {0.235F, -0.042F},
                                    {0.265F, -0.042F}}};
constexpr std::array<Knot, 8> kFace{{{-0.055F, 0.024F},
                                     {-0.02F, 0.044F},
                                     {0.03F, 0.055F},
                                     {0.08F, 0.052F},
                                     {0.13F, 0.036F},
                                     {0.19F, 0.025F},
                                     {0.235F, 0.024F},
                                     {0.265F, 0.023F}}};

constexpr float kEarLength = 0.165F;

/// Half of it, by share of the length.
float earWidth(float along) {
  return raster::profile({{0.0F, 0.018F}, {0.45F, 0.041F}, {0.8F, 0.026F}, {1.0F, 0.005F}}, along);
}

}  // namespace

Surface makeSkull(const Build& build) {
  return raster::makeTube(
      1, 4,
      [&](float along, float) {
        const float ahead = glm::mix(kSkullBack, kHeadLength + 0.008F, along);
        const float top = curve(kBrow, ahead);
        const float bottom = curve(kJaw, ahead);
        const float cap = rounded(along, 0.05F, 0.06F) * build.head;
        return Ring{kNeckEnd + build.head * Vec3(0.0F, 0.5F * (top + bottom), -ahead),
                    {curve(kFace, ahead) * cap, 0.0F, 0.0F},
                    {0.0F, 0.5F * (top - bottom) * cap, 0.0F}};
      },
      [&](Vertex& vertex, float along, float angle) {
        const float ahead = glm::mix(kSkullBack, kHeadLength, along);
        const float down = std::cos(angle);
        Vec3 coat =
            glm::mix(1.1F * kChestnut, kDarkCoat, 0.7F * within(down, -0.95F, -0.6F) * within(ahead, 0.20F, 0.05F));
        coat = glm::mix(coat, kPaleCoat, within(down, 0.8F, 0.25F));
        // Pale around the muzzle, and a dark nose on it.
        coat = glm::mix(coat, kPaleCoat, 0.8F * within(ahead, 0.225F, 0.195F));
        coat = glm::mix(coat, kNose, within(ahead, 0.248F, 0.228F) * within(down, 0.0F, 0.5F));
        vertex.albedo = coat;
      });
}

Surface makeEye(const Build& build, float side) {
  const Vec3 centre = kNeckEnd + build.head * Vec3(0.046F * side, 0.022F, -0.075F);
  const float radius = 0.0155F * build.head;
  return raster::makeTube(
      1, 1,
      [&](float along, float) {
        const float up = 2.0F * along - 1.0F;
        const float round = std::sqrt(std::max(0.02F, 1.0F - up * up));
        return Ring{centre + Vec3(0.0F, 0.85F * radius * up, 0.0F),
                    {0.75F * radius * round, 0.0F, 0.0F},
                    {0.0F, 0.0F, 1.2F * radius * round}};
      },
      [](Vertex& vertex, float, float) { vertex.albedo = kEyeBlack; });
}

Surface makeEar(float side) {
  const Vec3 root = kNeckEnd + Vec3(-side * kLeftEarRoot.x, kLeftEarRoot.y, kLeftEarRoot.z);
  return raster::makeTube(
      1, 2,
      [&](float along, float) {
        const float width = earWidth(along);
        return Ring{
            root + Vec3(0.0F, kEarLength * along - 0.02F, 0.0F), {width, 0.0F, 0.0F}, {0.0F, 0.0F, 0.4F * width}};
      },
      [](Vertex& vertex, float along, float angle) {
        const float inside = within(std::abs(angle), 0.9F, 1.35F);
        const float rim = within(along, 0.85F, 0.6F);
        // The front is hollow.
        vertex.position.z += 0.55F * earWidth(along) * inside;
        vertex.albedo =
            glm::mix(glm::mix(0.9F * kChestnut, kDarkCoat, rim), 0.8F * kPaleCoat, inside * (1.0F - 0.6F * rim));
      });
}

}  // namespace grove::objects::herd
