#include "objects/herd/frontend/body/deer_shape.h"

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "objects/herd/frontend/body/deer_parts.h"
#include "raster/joined_surface.h"

namespace grove::objects::herd {
namespace {

static_assert(kBones <= raster::kMaxBones);

constexpr std::array<Build, kKinds> kBuilds{{
    {},
    {.neck = 1.32F, .trunk = 1.05F, .legs = 1.08F, .spots = 0.75F, .antlers = true},
    {.neck = 0.92F, .trunk = 0.90F, .legs = 1.06F, .head = 1.12F, .spots = 1.1F},
}};

constexpr std::array<float, 2> kSides{-1.0F, 1.0F};

/// Lets a part grow out of the trunk: where it leaves it, light falls on both as on one skin.
raster::Surface grownFrom(const Build& build, raster::Surface part) {
  constexpr float kSeam = 0.05F;
  for (raster::Vertex& vertex : part.vertices) {
    const Skin skin = skinNear(build, vertex.position);
    // Not on its inner side, which faces the other leg.
    const float alike = within(glm::dot(vertex.normal, skin.normal), 0.3F, -0.1F);
    const float share = within(skin.outside, 0.0F, kSeam) * alike;
    vertex.normal = glm::normalize(glm::mix(vertex.normal, skin.normal, 0.9F * share));
  }
  return part;
}

/// The parts of a deer, while it is made.
class Body {
 public:
  /// The body hides shares of the sky from what is below and within it.
  void add(raster::Surface part, std::size_t bone, float sun = 1.0F) {
    for (raster::Vertex& vertex : part.vertices) {
      vertex.bone = static_cast<float>(bone);
      const float low = glm::clamp(vertex.position.y / kTrunkHeight, 0.0F, 1.0F);
      const float inside = 1.0F - glm::clamp(std::abs(vertex.position.x) / 0.07F, 0.0F, 1.0F);
      const bool isBelow = bone >= kFirstLegBone || vertex.normal.y < -0.3F;
      const float sky = (0.62F + 0.33F * low) * (isBelow ? 1.0F - 0.35F * inside : 1.0F);
      light_.emplace_back(sun, sky, sky, sky);
    }
    parts_.push_back(std::move(part));
  }

  [[nodiscard]] raster::LitSurface surface() const {
    raster::LitSurface deer{raster::joined(parts_), {}, false};
    deer.light.reserve(light_.size());
    for (const std::uint32_t vertex : deer.surface.putCoarseFirst()) deer.light.push_back(light_[vertex]);
    return deer;
  }

 private:
  std::vector<raster::Surface> parts_;
  std::vector<world::Vec4> light_;
};

void addHead(Body& body, const Build& build) {
  body.add(makeSkull(build), kHead);
  for (const float side : kSides) {
    body.add(makeEye(build, side), kHead);
    if (!build.antlers) continue;
    body.add(makeBeam(side), kHead);
    body.add(makeBrowTine(side), kHead);
    body.add(makePalm(side), kHead);
  }
  body.add(makeEar(-1.0F), kLeftEar);
  body.add(makeEar(1.0F), kRightEar);
}

}  // namespace

raster::LitSurface makeDeer(Kind kind) {
  const Build& build = kBuilds[static_cast<std::size_t>(kind)];
  Body body;
  body.add(makePelvis(build), kPelvis);
  body.add(makeChest(build), kChest);
  body.add(makeSpots(build, false), kPelvis);
  body.add(makeSpots(build, true), kChest);
  body.add(grownFrom(build, makeLowerNeck(build)), kLowerNeck);
  body.add(makeUpperNeck(build), kUpperNeck);
  body.add(makeTail(), kTail);
  addHead(body, build);
  for (std::size_t leg = 0; leg < kLegs; ++leg) {
    for (std::size_t part = 0; part < 3; ++part) {
      raster::Surface surface = makeLegPart(build, static_cast<Leg>(leg), part);
      if (part == 0) surface = grownFrom(build, std::move(surface));
      body.add(std::move(surface), kFirstLegBone + 3 * leg + part);
    }
  }
  return body.surface();
}

}  // namespace grove::objects::herd
