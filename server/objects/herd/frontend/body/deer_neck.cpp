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

// The neck from the breast to the head, by metres ahead of its root.
constexpr std::array<Knot, 6> kNeckTop{
    {{-0.08F, 0.030F}, {0.0F, 0.046F}, {0.10F, 0.052F}, {0.27F, 0.048F}, {0.42F, 0.046F}, {0.56F, 0.042F}}};
constexpr std::array<Knot, 6> kNeckBottom{
    {{-0.08F, -0.205F}, {0.0F, -0.195F}, {0.10F, -0.140F}, {0.27F, -0.085F}, {0.42F, -0.063F}, {0.56F, -0.052F}}};
constexpr std::array<Knot, 6> kNeckHalfWidth{
    {{-0.08F, 0.082F}, {0.0F, 0.080F}, {0.10F, 0.070F}, {0.27F, 0.054F}, {0.42F, 0.045F}, {0.56F, 0.041F}}};

/// Where a buck's neck is thickest; metres ahead of its root.
constexpr float kThroat = 0.30F;

Surface makeNeck(const Build& build, float from, float to, float lowCap, float highCap) {
  return raster::makeTube(
      1, 3,
      [&](float along, float) {
        const float ahead = glm::mix(from, to, along);
        const float cap = rounded(along, lowCap, highCap);
        // A buck's neck is thick in the middle.
        const float thick = glm::mix(build.neck, 1.0F, std::abs(ahead - kThroat) / kThroat);
        const float top = curve(kNeckTop, ahead);
        const float bottom = curve(kNeckBottom, ahead) * thick;
        return Ring{kNeckRoot + Vec3(0.0F, 0.5F * (top + bottom), -ahead),
                    {curve(kNeckHalfWidth, ahead) * thick * cap, 0.0F, 0.0F},
                    {0.0F, 0.5F * (top - bottom) * cap, 0.0F}};
      },
      [&](Vertex& vertex, float along, float angle) {
        const float ahead = glm::mix(from, to, along);
        const float down = std::cos(angle);
        Vec3 coat = glm::mix(kChestnut, kDarkCoat, 0.8F * within(down, -1.0F, -0.75F));
        coat = glm::mix(coat, kPaleCoat, 0.9F * within(down, 0.9F, 0.5F) * within(ahead, 0.16F, 0.02F));
        vertex.albedo = coat;
      });
}

}  // namespace

Surface makeLowerNeck(const Build& build) { return makeNeck(build, -0.08F, kLowerNeckLength + 0.05F, 0.25F, 0.12F); }

Surface makeUpperNeck(const Build& build) {
  return makeNeck(build, kLowerNeckLength - 0.06F, kLowerNeckLength + kUpperNeckLength + 0.025F, 0.17F, 0.12F);
}

Surface makeTail() {
  constexpr float kLength = 0.19F;
  return raster::makeTube(
      1, 2,
      [](float along, float) {
        const float width = raster::profile({{0.0F, 0.022F}, {0.45F, 0.027F}, {1.0F, 0.006F}}, along);
        const Vec3 centre = kTailRoot + Vec3(0.0F, 0.0F, kLength * along - 0.02F);
        return Ring{centre, {width, 0.0F, 0.0F}, {0.0F, -0.65F * width, 0.0F}};
      },
      [](Vertex& vertex, float, float angle) {
        vertex.albedo = glm::mix(kWhiteCoat, kBlackCoat, within(std::cos(angle), 0.3F, -0.1F));
      });
}

}  // namespace grove::objects::herd
