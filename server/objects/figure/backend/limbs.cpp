#include "objects/figure/backend/limbs.h"

#include <algorithm>
#include <cmath>

#include "raster/tube.h"

namespace grove::objects::figure {
namespace {

using raster::levelRing;
using raster::makeTube;
using raster::profile;
using raster::squareRing;
using raster::Surface;
using raster::Vertex;
using world::Vec3;

const Vec3 kSleeve{0.27F, 0.25F, 0.24F};
const Vec3 kTrousers{0.060F, 0.050F, 0.042F};
const Vec3 kBoot{0.075F, 0.040F, 0.022F};
const Vec3 kGlove{0.12F, 0.075F, 0.045F};
const Vec3 kIron{0.05F, 0.045F, 0.04F};
const Vec3 kLanternAt{0.27F, 0.0F, -0.40F};

struct Arm {
  Vec3 hand;
  Vec3 elbow;
  Vec3 shoulder;
};

Surface makeArm(const Arm& arm) {
  return makeTube(
      1, 3,
      [&](float along, float) {
        const Vec3 centre =
            glm::mix(glm::mix(arm.hand, arm.elbow, along), glm::mix(arm.elbow, arm.shoulder, along), along);
        const Vec3 way = glm::mix(arm.elbow - arm.hand, arm.shoulder - arm.elbow, along);
        const float radius =
            profile({{0.0F, 0.030F}, {0.12F, 0.045F}, {0.2F, 0.088F}, {0.6F, 0.072F}, {1.0F, 0.055F}}, along);
        return squareRing(centre, way, radius);
      },
      [](Vertex& vertex, float along, float) {
        const float sleeve = glm::smoothstep(0.12F, 0.2F, along);
        vertex.albedo = glm::mix(kGlove, kSleeve, sleeve);
        vertex.tint = 0.75F * sleeve;
      });
}

}  // namespace

Surface makeLeg(float side, float length) {
  return makeTube(
      1, 3,
      [&](float along, float angle) {
        const float y = length * along;
        const float foot = 1.0F - glm::smoothstep(0.05F, 0.14F, y);
        const float toe = foot * std::pow(std::max(0.0F, std::cos(angle)), 0.4F);
        const float radius = profile(
            {{0.0F, 0.055F}, {0.07F, 0.058F}, {0.28F, 0.062F}, {0.33F, 0.078F}, {0.37F, 0.060F}, {0.66F, 0.075F}}, y);
        return levelRing(Vec3(0.09F * side, y, -0.02F), radius + 0.012F * foot, radius + 0.13F * toe);
      },
      [&](Vertex& vertex, float along, float) {
        const float y = length * along;
        const bool isInside = along > 0.97F;
        vertex.albedo = glm::mix(kBoot * (y < 0.03F ? 0.4F : 1.0F), kTrousers, glm::smoothstep(0.33F, 0.37F, y));
        if (isInside) vertex.albedo = 0.4F * kTrousers;
      });
}

Surface makeLeftArm() {
  return makeArm({Vec3(-0.10F, 1.04F, -0.27F), Vec3(-0.33F, 0.98F, -0.03F), Vec3(-0.165F, kShoulderHeight, 0.01F)});
}

Surface makeRightArm() {
  return makeArm({Vec3(0.27F, 1.05F, -0.40F), Vec3(0.31F, 1.02F, 0.0F), Vec3(0.165F, kShoulderHeight, 0.01F)});
}

Surface makeLantern() {
  const auto isGlass = [](float along) { return along > 0.1F && along < 0.75F; };
  return makeTube(
      1, 5,
      [&](float along, float) {
        const float roof = std::max(0.0F, along - 0.75F) * 4.0F;
        const float radius = (isGlass(along) ? 0.062F : 0.078F) * (1.0F - 0.92F * roof);
        return levelRing(kLanternAt + Vec3(0.0F, 0.76F + 0.25F * along, 0.0F), radius, radius);
      },
      [&](Vertex& vertex, float along, float) {
        vertex.albedo = isGlass(along) ? Vec3(1.0F) : kIron;
        vertex.emission = isGlass(along) ? 1.7F : 0.0F;
        vertex.tint = isGlass(along) ? 0.85F : 0.0F;
      });
}

}  // namespace grove::objects::figure
