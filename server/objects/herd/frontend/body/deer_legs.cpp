#include <array>
#include <cmath>

#include "objects/herd/frontend/body/deer_parts.h"

namespace grove::objects::herd {
namespace {

using raster::Knot;
using raster::Surface;
using raster::Vertex;
using world::Vec3;

/// A part of a leg by metres below its upper joint: half width and half depth, and how far ahead its middle is.
struct LegShape {
  std::array<Knot, 5> width;
  std::array<Knot, 5> depth;
  std::array<Knot, 5> ahead;
  float above = 0.0F;  ///< metres that it reaches beyond its joints
  float below = 0.0F;
  float lowCap = 0.1F;  ///< share of the length that the lower end's rounding takes
  float highCap = 0.1F;
};

constexpr std::array<Knot, 5> kNowhereAhead{{{-0.1F, 0.0F}, {0.0F, 0.0F}, {0.1F, 0.0F}, {0.2F, 0.0F}, {0.3F, 0.0F}}};

constexpr LegShape kShoulder{{{{-0.1F, 0.020F}, {0.0F, 0.036F}, {0.10F, 0.042F}, {0.18F, 0.037F}, {0.26F, 0.030F}}},
                             {{{-0.1F, 0.050F}, {0.0F, 0.080F}, {0.10F, 0.076F}, {0.18F, 0.058F}, {0.26F, 0.038F}}},
                             kNowhereAhead,
                             0.05F,
                             0.030F,
                             0.15F,
                             0.4F};
constexpr LegShape kForearm{{{{-0.03F, 0.030F}, {0.04F, 0.032F}, {0.14F, 0.024F}, {0.22F, 0.0185F}, {0.27F, 0.021F}}},
                            {{{-0.03F, 0.038F}, {0.04F, 0.041F}, {0.14F, 0.027F}, {0.22F, 0.0195F}, {0.27F, 0.023F}}},
                            kNowhereAhead,
                            0.035F,
                            0.022F,
                            0.08F,
                            0.12F};
constexpr LegShape kThigh{{{{-0.08F, 0.024F}, {0.02F, 0.046F}, {0.14F, 0.052F}, {0.24F, 0.043F}, {0.33F, 0.033F}}},
                          {{{-0.08F, 0.070F}, {0.02F, 0.120F}, {0.14F, 0.112F}, {0.24F, 0.078F}, {0.33F, 0.048F}}},
                          {{{-0.08F, 0.0F}, {0.02F, -0.015F}, {0.14F, -0.028F}, {0.24F, -0.012F}, {0.33F, 0.0F}}},
                          0.03F,
                          0.042F,
                          0.15F,
                          0.4F};
constexpr LegShape kGaskin{{{{-0.04F, 0.034F}, {0.05F, 0.036F}, {0.15F, 0.026F}, {0.25F, 0.0185F}, {0.31F, 0.020F}}},
                           {{{-0.04F, 0.048F}, {0.05F, 0.054F}, {0.15F, 0.036F}, {0.25F, 0.022F}, {0.31F, 0.027F}}},
                           kNowhereAhead,
                           0.04F,
                           0.024F,
                           0.08F,
                           0.12F};

/// A cannon bone with the fetlock and the hoof at its end, by metres above the sole.
constexpr std::array<Knot, 7> kCannonWidth{{{0.0F, 0.024F},
                                            {0.035F, 0.019F},
                                            {0.06F, 0.0155F},
                                            {0.085F, 0.0185F},
                                            {0.12F, 0.0135F},
                                            {0.22F, 0.0140F},
                                            {0.32F, 0.0195F}}};
constexpr std::array<Knot, 7> kCannonDepth{{{0.0F, 0.032F},
                                            {0.035F, 0.022F},
                                            {0.06F, 0.0165F},
                                            {0.085F, 0.0205F},
                                            {0.12F, 0.0150F},
                                            {0.22F, 0.0160F},
                                            {0.32F, 0.0230F}}};
constexpr std::array<Knot, 7> kCannonAhead{{{0.0F, 0.020F},
                                            {0.035F, 0.012F},
                                            {0.06F, 0.002F},
                                            {0.085F, -0.008F},
                                            {0.12F, -0.002F},
                                            {0.22F, 0.0F},
                                            {0.32F, 0.0F}}};

bool isForeLeg(Leg leg) { return leg == kLeftFore || leg == kRightFore; }

/// Chestnut outside, pale inside.
Vec3 legCoat(float inwards) { return glm::mix(kChestnut, kPaleCoat, 0.75F * within(inwards, 0.8F, 0.2F)); }

Surface makeUpperPart(const LegShape& shape, Vec3 joint, float length, const Build& build, float side, bool isThigh) {
  const float whole = length + shape.above + shape.below;
  return raster::makeTube(
      1, 2,
      [&](float along, float) {
        const float down = length + shape.below - whole * along;
        const float cap = rounded(along, shape.lowCap, shape.highCap) * build.legs;
        return raster::levelRing(joint + Vec3(0.0F, -down, -curve(shape.ahead, down)), curve(shape.width, down) * cap,
                                 curve(shape.depth, down) * cap);
      },
      [&](Vertex& vertex, float along, float angle) {
        const float inwards = -side * std::sin(angle);
        vertex.albedo = legCoat(inwards);
        // The rump patch goes on behind the thighs.
        if (isThigh) {
          const float behind = -std::cos(angle);
          vertex.albedo = glm::mix(vertex.albedo, kPaleCoat, within(behind, 0.95F, 0.7F) * within(along, 0.15F, 0.0F));
        }
      });
}

Surface makeCannon(Vec3 joint, float length, const Build& build, float side) {
  constexpr float kAbove = 0.02F;
  return raster::makeTube(
      1, 2,
      [&](float along, float) {
        // Half of the rows are in the lowest third, with fetlock and hoof.
        const float up = (length + kAbove) * glm::mix(along, along * along, 0.6F);
        const float at = up < 0.12F ? up : glm::mix(0.12F, 0.32F, (up - 0.12F) / (length + kAbove - 0.12F));
        const float cap = std::max(0.5F, rounded(along, 0.02F, 0.1F)) * build.legs;
        return raster::levelRing(joint + Vec3(0.0F, up - length, -curve(kCannonAhead, at)),
                                 curve(kCannonWidth, at) * cap, curve(kCannonDepth, at) * cap);
      },
      [&](Vertex& vertex, float, float angle) {
        const float up = vertex.position.y - joint.y + length;
        const float inwards = -side * std::sin(angle);
        const float front = std::cos(angle);
        Vec3 coat = glm::mix(legCoat(inwards), kPaleCoat, 0.35F * within(front, -0.9F, 0.0F));
        coat = glm::mix(coat, kDarkCoat, 0.5F * within(up, 0.06F, 0.10F));
        vertex.albedo = glm::mix(coat, kBlackCoat, within(up, 0.036F, 0.046F));
      });
}

}  // namespace

Surface makeLegPart(const Build& build, Leg leg, std::size_t part) {
  const LegBones& bones = legBones(leg);
  const bool isFore = isForeLeg(leg);
  const float side = leg == kLeftFore || leg == kLeftHind ? -1.0F : 1.0F;
  const Vec3 root = legRoot(leg);
  if (part == 0) return makeUpperPart(isFore ? kShoulder : kThigh, root, bones.upper, build, side, !isFore);
  const Vec3 middle = root - Vec3(0.0F, bones.upper, 0.0F);
  if (part == 1) return makeUpperPart(isFore ? kForearm : kGaskin, middle, bones.lower, build, side, false);
  return makeCannon(middle - Vec3(0.0F, bones.lower, 0.0F), bones.cannon, build, side);
}

}  // namespace grove::objects::herd
