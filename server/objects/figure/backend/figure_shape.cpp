#include "objects/figure/backend/figure_shape.h"

#include <cstdint>
#include <utility>
#include <vector>

#include "objects/figure/backend/garments.h"
#include "objects/figure/backend/limbs.h"

namespace grove::objects::figure {
namespace {

/// Shares of sun and sky that reach a part.
struct Openness {
  float sun = 1.0F;
  float sky = 0.9F;
};

// Metres. Visitors see only the boots of their own legs: whole legs would hide the boots from above.
constexpr float kLegs = 0.66F;
constexpr float kOwnLegs = 0.34F;

constexpr Openness kOutside;
constexpr Openness kUnderTheCloak{0.6F, 0.45F};
constexpr Openness kInTheHood{0.3F, 0.5F};

void add(raster::LitSurface& to, raster::Surface part, Bone bone, const Openness& openness = kOutside) {
  for (raster::Vertex& vertex : part.vertices) {
    vertex.bone = static_cast<float>(bone);
    // The ground shades the lower half a little.
    const float low = glm::clamp(vertex.position.y / 0.8F, 0.0F, 1.0F);
    const float sky = openness.sky * (0.6F + 0.4F * low);
    to.light.emplace_back(openness.sun, sky, sky, sky);
  }
  to.surface.append(part, world::Mat4(1.0F));
}

/// What is the same for all parts, when they are complete.
void finish(raster::LitSurface& figure) {
  const std::vector<world::Vec4> light = std::move(figure.light);
  figure.light.clear();
  figure.light.reserve(light.size());
  for (const std::uint32_t vertex : figure.surface.putCoarseFirst()) figure.light.push_back(light[vertex]);
}

void addLegs(raster::LitSurface& to, float length) {
  add(to, makeLeg(-1.0F, length), kLeftLeg, kUnderTheCloak);
  add(to, makeLeg(1.0F, length), kRightLeg, kUnderTheCloak);
}

}  // namespace

raster::LitSurface makeFigure(float breadth) {
  raster::LitSurface figure{{}, {}, false};
  add(figure, makeCloak(), kBody);
  add(figure, makeMantle(), kBody);
  for (raster::Vertex& vertex : figure.surface.vertices) vertex.position *= world::Vec3(breadth, 1.0F, breadth);
  figure.surface.computeNormals();
  add(figure, makeHood(), kBody);
  add(figure, makeFace(), kBody, kInTheHood);
  add(figure, makeLeftArm(), kBody);
  addLegs(figure, kLegs);
  add(figure, makeRightArm(), kArm);
  add(figure, makeLantern(), kArm);
  finish(figure);
  return figure;
}

raster::LitSurface makeOwnFigure() {
  raster::LitSurface figure{{}, {}, false};
  addLegs(figure, kOwnLegs);
  finish(figure);
  return figure;
}

}  // namespace grove::objects::figure
