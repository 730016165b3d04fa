#include "objects/figure/backend/garments.h"

#include "raster/tube.h"

namespace grove::objects::figure {
namespace {

using raster::levelRing;
using raster::makeTube;
using raster::profile;
using raster::Surface;
using raster::Vertex;
using world::Vec3;

const Vec3 kCloth{0.30F, 0.28F, 0.27F};
const Vec3 kTunic{0.075F, 0.062F, 0.048F};
const Vec3 kBelt{0.035F, 0.022F, 0.014F};
const Vec3 kSkin{0.36F, 0.21F, 0.14F};
const Vec3 kDark{0.010F, 0.009F, 0.009F};

constexpr float kHem = 0.24F;   // metres above the ground
constexpr float kNeck = 1.46F;  // the same

/// Depth of the folds at an angle, -1.5 to 1.5.
float folds(float angle) {
  return std::cos(7.0F * angle + 1.1F * std::sin(2.0F * angle)) + 0.5F * std::cos(4.0F * angle + 2.0F);
}

/// Openness of the cloak's front at a place: 1 in the middle, 0 beyond its edges.
float opening(float along, float angle) {
  const float halfWidth = profile({{0.0F, 0.50F}, {0.6F, 0.34F}, {0.85F, 0.22F}, {1.0F, 0.1F}}, along);
  return 1.0F - glm::smoothstep(0.75F * halfWidth, halfWidth, std::abs(angle));
}

}  // namespace

Surface makeCloak() {
  return makeTube(
      2, 4,
      [](float along, float angle) {
        const float low = 1.0F - along;
        const float width = 1.0F + 0.07F * low * folds(angle) - 0.12F * opening(along, angle);
        const float hem = 0.025F * low * std::cos(3.0F * angle + 1.0F);
        const float across = profile({{0.0F, 0.33F}, {0.55F, 0.235F}, {0.9F, 0.205F}, {1.0F, 0.07F}}, along);
        const float deep = profile({{0.0F, 0.29F}, {0.55F, 0.165F}, {0.9F, 0.125F}, {1.0F, 0.07F}}, along);
        const Vec3 centre(0.0F, glm::mix(kHem, kNeck, along) + hem, 0.045F * low);
        return levelRing(centre, across * width, deep * width);
      },
      [](Vertex& vertex, float along, float angle) {
        const float open = opening(along, angle);
        const float belt = 1.0F - glm::smoothstep(0.02F, 0.035F, std::abs(along - 0.62F));
        const float trim = 1.0F - glm::smoothstep(0.03F, 0.06F, along);
        vertex.albedo = glm::mix(kCloth * (1.0F + 0.5F * trim + 0.16F * (1.0F - along) * folds(angle)),
                                 glm::mix(kTunic, kBelt, belt), open);
        vertex.tint = glm::mix(0.75F + 0.2F * trim, 0.1F, open);
      });
}

Surface makeMantle() {
  return makeTube(
      1, 2,
      [](float along, float angle) {
        const float points = 0.045F * (1.0F - along) * std::cos(6.0F * angle);
        const float across = profile({{0.0F, 0.268F}, {0.55F, 0.245F}, {0.85F, 0.17F}, {1.0F, 0.08F}}, along);
        const float deep = profile({{0.0F, 0.192F}, {0.55F, 0.165F}, {0.85F, 0.13F}, {1.0F, 0.08F}}, along);
        return levelRing(Vec3(0.0F, glm::mix(1.16F, 1.49F, along) + points, 0.01F), across, deep);
      },
      [](Vertex& vertex, float along, float) {
        const float trim = 1.0F - glm::smoothstep(0.06F, 0.14F, along);
        vertex.albedo = kCloth * (1.1F + 0.6F * trim);
        vertex.tint = 0.85F + 0.1F * trim;
      });
}

Surface makeHood() {
  return makeTube(
      1, 3,
      [](float along, float) {
        const float across = profile({{0.0F, 0.10F}, {0.35F, 0.132F}, {0.65F, 0.112F}, {1.0F, 0.012F}}, along);
        const float deep = profile({{0.0F, 0.10F}, {0.35F, 0.150F}, {0.65F, 0.135F}, {1.0F, 0.014F}}, along);
        // The point hangs backwards.
        const float back = profile({{0.0F, 0.0F}, {0.4F, -0.02F}, {0.7F, 0.03F}, {1.0F, 0.15F}}, along);
        return levelRing(Vec3(0.0F, 1.40F + 0.42F * along, back), across, deep);
      },
      [](Vertex& vertex, float along, float angle) {
        const float edge = std::hypot((along - 0.40F) / 0.30F, angle / 0.80F);
        const float inside = 1.0F - glm::smoothstep(0.80F, 1.0F, edge);
        const float rim = glm::smoothstep(0.8F, 1.0F, edge) * (1.0F - glm::smoothstep(1.0F, 1.45F, edge));
        vertex.position.z += 0.13F * inside - 0.022F * rim;
        vertex.albedo = glm::mix(kCloth * (1.0F + 0.4F * rim), kDark, inside);
        vertex.tint = 0.85F * (1.0F - inside);
      });
}

Surface makeFace() {
  return makeTube(
      1, 2,
      [](float along, float) {
        const float round = std::sqrt(std::max(0.0F, 1.0F - std::pow(2.0F * along - 1.0F, 2.0F)));
        return levelRing(Vec3(0.0F, 1.455F + 0.20F * along, -0.052F), 0.012F + 0.066F * round, 0.012F + 0.075F * round);
      },
      [](Vertex& vertex, float along, float angle) {
        const float nose = std::exp(-std::pow((along - 0.5F) / 0.16F, 2.0F) - std::pow(angle / 0.3F, 2.0F));
        const float eyes =
            std::exp(-std::pow((along - 0.62F) / 0.07F, 2.0F) - std::pow((std::abs(angle) - 0.5F) / 0.22F, 2.0F));
        vertex.position.z -= 0.022F * nose;
        // The hood shades the brow.
        const float shadow = 1.0F - 0.75F * glm::smoothstep(0.45F, 0.8F, along);
        vertex.albedo = kSkin * shadow * (1.0F - 0.8F * eyes);
      });
}

}  // namespace grove::objects::figure
