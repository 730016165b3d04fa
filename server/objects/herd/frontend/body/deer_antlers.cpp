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

// By share of the length, from the head: metres outwards, up and back of the neck's end.
constexpr std::array<Knot, 4> kOut{{{0.0F, 0.030F}, {0.3F, 0.115F}, {0.6F, 0.205F}, {1.0F, 0.200F}}};
constexpr std::array<Knot, 4> kUpwards{{{0.0F, 0.055F}, {0.3F, 0.140F}, {0.6F, 0.260F}, {1.0F, 0.455F}}};
constexpr std::array<Knot, 4> kBackwards{{{0.0F, -0.02F}, {0.3F, 0.065F}, {0.6F, 0.105F}, {1.0F, 0.045F}}};
constexpr float kPalmBegins = 0.52F;

const Vec3 kAntlerRoot = kNeckRoot - Vec3(0.0F, 0.0F, kLowerNeckLength + kUpperNeckLength);

Vec3 antlerAt(float along, float side) {
  return kAntlerRoot + Vec3(side * curve(kOut, along), curve(kUpwards, along), curve(kBackwards, along));
}

void paintAntler(Vertex& vertex, float along) { vertex.albedo = kHorn * (0.75F + 0.6F * along); }

}  // namespace

Surface makeBeam(float side) {
  constexpr float kEnd = kPalmBegins + 0.1F;
  return raster::makeTube(
      1, 3,
      [&](float along, float) {
        const float at = kEnd * along;
        const Vec3 way = antlerAt(at + 0.02F, side) - antlerAt(at - 0.02F, side);
        const float radius = raster::profile({{0.0F, 0.024F}, {0.12F, 0.017F}, {1.0F, 0.014F}}, along);
        return raster::squareRing(antlerAt(at, side), way, radius);
      },
      [](Vertex& vertex, float along, float) { paintAntler(vertex, 0.5F * along); });
}

Surface makeBrowTine(float side) {
  const Vec3 root = antlerAt(0.07F, side);
  return raster::makeTube(
      1, 1,
      [&](float along, float) {
        const Vec3 centre = root + Vec3(side * 0.045F * along, 0.02F * along + 0.09F * along * along, -0.14F * along);
        const Vec3 way(side * 0.045F, 0.02F + 0.18F * along, -0.14F);
        return raster::squareRing(centre, way, 0.013F * (1.0F - 0.8F * along));
      },
      [](Vertex& vertex, float along, float) { paintAntler(vertex, along); });
}

Surface makePalm(float side) {
  return raster::makeTube(
      1, 4,
      [&](float along, float angle) {
        const float at = glm::mix(kPalmBegins - 0.06F, 1.0F, along);
        const float breadth =
            raster::profile({{0.0F, 0.012F}, {0.3F, 0.040F}, {0.7F, 0.072F}, {0.92F, 0.060F}, {1.0F, 0.018F}}, along);
        // The rear edge ends in points; the palm widens backwards.
        const float rear = std::max(0.0F, -std::cos(angle));
        const float points = 0.30F + 0.55F * std::max(0.0F, std::cos(along * 8.0F * 3.1415927F));
        const float back = breadth * (1.0F + rear * points * glm::smoothstep(0.1F, 0.4F, along));
        const Vec3 inwards = glm::normalize(Vec3(side, -0.25F, 0.15F));
        const Vec3 backwards = glm::normalize(Vec3(side * -0.15F, 0.12F, 1.0F));
        return Ring{antlerAt(at, side), 0.011F * side * inwards, back * backwards};
      },
      [](Vertex& vertex, float along, float) { paintAntler(vertex, 0.4F + 0.6F * along); });
}

}  // namespace grove::objects::herd
