#include "objects/figure/backend/figure_shape.h"

#include <algorithm>
#include <cmath>

namespace grove::objects::figure {
namespace {

using raster::Surface;
using raster::Vertex;
using world::Vec3;

const Vec3 kCloth{0.30F, 0.28F, 0.27F};
const Vec3 kLeather{0.10F, 0.065F, 0.04F};

/// A cross-section of a tube.
struct Ring {
  Vec3 centre{0.0F};
  float radiusX = 0.1F;
  float radiusZ = 0.1F;
};

/// A closed tube: `ring` and `paint` are asked for a share 0..1 of its length and an angle, 0 in
/// front. There are 8 `around` corners around it.
template <class RingAt, class Paint>
Surface makeTube(int around, int segments, const RingAt& ring, const Paint& paint) {
  return raster::makeDeformedBox({around, segments, around}, 1, [&](Vec3 cube) {
    const float along = 0.5F * (cube.y + 1.0F);
    const float square = std::max(std::abs(cube.x), std::abs(cube.z));
    const float circle = std::hypot(cube.x, cube.z);
    const float out = circle > 0.0F ? square / circle : 0.0F;
    const Ring at = ring(along, std::atan2(cube.x, -cube.z));
    Vertex vertex;
    vertex.position = at.centre + Vec3(cube.x * out * at.radiusX, 0.0F, cube.z * out * at.radiusZ);
    paint(vertex, along, std::atan2(cube.x, -cube.z));
    return vertex;
  });
}

Surface makeCloak() {
  return makeTube(
      2, 5,
      [](float along, float angle) {
        const float bell = 1.0F - std::pow(along, 0.7F);
        const float fold = 1.0F + 0.09F * (1.0F - along) * std::cos(7.0F * angle);
        const float hem = 0.03F * (1.0F - along) * std::cos(3.0F * angle + 1.0F);
        return Ring{Vec3(0.0F, 0.20F + 1.24F * along + hem, 0.03F * (1.0F - along)), (0.15F + 0.21F * bell) * fold,
                    (0.12F + 0.22F * bell) * fold};
      },
      [](Vertex& vertex, float along, float) {
        vertex.albedo = kCloth * (along < 0.06F ? 1.6F : 1.0F);
        vertex.tint = along < 0.06F ? 0.95F : 0.7F;
      });
}

Surface makeHood() {
  return makeTube(
      2, 4,
      [](float along, float) {
        const float round = std::sqrt(std::max(0.0F, 1.0F - std::pow(2.0F * along - 0.85F, 2.0F) / 1.35F));
        return Ring{Vec3(0.0F, 1.36F + 0.39F * along, -0.03F + 0.10F * along * along), 0.02F + 0.135F * round,
                    0.02F + 0.155F * round};
      },
      [](Vertex& vertex, float along, float angle) {
        const float face = std::pow((along - 0.48F) / 0.34F, 2.0F) + std::pow(angle / 0.85F, 2.0F);
        vertex.albedo = face < 1.0F ? Vec3(0.012F, 0.010F, 0.010F) : kCloth;
        vertex.tint = face < 1.0F ? 0.0F : 0.8F;
        if (face < 1.0F) vertex.position.z += 0.05F * (1.0F - face);
      });
}

Surface makeLeg(float side) {
  return makeTube(
      1, 3,
      [&](float along, float angle) {
        const float boot = along < 0.2F ? 1.0F : 0.0F;
        const float toe = boot * std::max(0.0F, std::cos(angle));
        return Ring{Vec3(0.085F * side, 0.55F * along, -0.02F - 0.03F * boot), 0.062F, 0.07F + 0.07F * toe};
      },
      [](Vertex& vertex, float along, float) { vertex.albedo = kLeather * (along < 0.3F ? 0.7F : 1.0F); });
}

Surface makeSleeve() {
  return makeTube(
      1, 3,
      [](float along, float) {
        const Vec3 shoulder(0.16F, kShoulderHeight - 0.02F, 0.0F);
        const Vec3 hand(0.25F, 1.02F, -0.36F);
        // A level cross-section cuts a slanting sleeve longer.
        return Ring{glm::mix(hand, shoulder, along), 0.055F + 0.025F * (1.0F - along), 0.08F};
      },
      [](Vertex& vertex, float along, float) {
        vertex.albedo = along < 0.08F ? Vec3(0.34F, 0.22F, 0.15F) : kCloth;
        vertex.tint = along < 0.08F ? 0.0F : 0.7F;
      });
}

Surface makeLantern() {
  return makeTube(
      1, 5,
      [](float along, float) {
        const bool glass = along > 0.1F && along < 0.75F;
        const float roof = std::max(0.0F, along - 0.75F) * 4.0F;
        return Ring{Vec3(0.25F, 0.76F + 0.25F * along, -0.38F), (glass ? 0.062F : 0.078F) * (1.0F - 0.92F * roof),
                    (glass ? 0.062F : 0.078F) * (1.0F - 0.92F * roof)};
      },
      [](Vertex& vertex, float along, float) {
        const bool glass = along > 0.1F && along < 0.75F;
        vertex.albedo = glass ? Vec3(1.0F) : Vec3(0.05F, 0.045F, 0.04F);
        vertex.emission = glass ? 1.7F : 0.0F;
        vertex.tint = glass ? 0.85F : 0.0F;
      });
}

void add(Surface& to, Surface part, Bone bone) {
  for (Vertex& vertex : part.vertices) vertex.bone = static_cast<float>(bone);
  to.append(part, world::Mat4(1.0F));
}

}  // namespace

raster::LitSurface makeFigure() {
  raster::LitSurface figure;
  figure.baked = false;
  add(figure.surface, makeCloak(), kBody);
  add(figure.surface, makeHood(), kBody);
  add(figure.surface, makeLeg(-1.0F), kLeftLeg);
  add(figure.surface, makeLeg(1.0F), kRightLeg);
  add(figure.surface, makeSleeve(), kArm);
  add(figure.surface, makeLantern(), kArm);
  // Limbs and lantern are thin and show their corners sooner than the typical edge suggests.
  for (raster::Level& level : figure.surface.levels) level.edge *= 2.0F;
  for (const Vertex& vertex : figure.surface.vertices) {
    // The cloak shades the legs, and the ground the lower half a little.
    const bool leg = vertex.bone == static_cast<float>(kLeftLeg) || vertex.bone == static_cast<float>(kRightLeg);
    const float low = glm::clamp(vertex.position.y / 0.8F, 0.0F, 1.0F);
    const float open = (leg ? 0.45F : 0.9F) * (0.6F + 0.4F * low);
    figure.light.emplace_back(leg ? 0.6F : 1.0F, open, open, open);
  }
  return figure;
}

}  // namespace grove::objects::figure
