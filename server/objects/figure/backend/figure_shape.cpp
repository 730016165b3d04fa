#include "objects/figure/backend/figure_shape.h"

#include <cstdint>
#include <utility>
#include <vector>

#include "objects/figure/backend/garments.h"
#include "objects/figure/backend/limbs.h"
#include "raster/joined_surface.h"

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

/// The parts of a figure, while it is made.
class Parts {
 public:
  void add(raster::Surface part, Bone bone, const Openness& openness = kOutside) {
    for (raster::Vertex& vertex : part.vertices) {
      vertex.bone = static_cast<float>(bone);
      // The ground shades the lower half a little.
      const float low = glm::clamp(vertex.position.y / 0.8F, 0.0F, 1.0F);
      const float sky = openness.sky * (0.6F + 0.4F * low);
      light_.emplace_back(openness.sun, sky, sky, sky);
    }
    parts_.push_back(std::move(part));
  }

  void addLegs(float length) {
    add(makeLeg(-1.0F, length), kLeftLeg, kUnderTheCloak);
    add(makeLeg(1.0F, length), kRightLeg, kUnderTheCloak);
  }

  [[nodiscard]] raster::LitSurface figure() const {
    raster::LitSurface figure{raster::joined(parts_), {}, false};
    figure.light.reserve(light_.size());
    for (const std::uint32_t vertex : figure.surface.putCoarseFirst()) figure.light.push_back(light_[vertex]);
    return figure;
  }

 private:
  std::vector<raster::Surface> parts_;
  std::vector<world::Vec4> light_;
};

/// For a figure of this breadth.
raster::Surface broadened(raster::Surface garment, float breadth) {
  for (raster::Vertex& vertex : garment.vertices) vertex.position *= world::Vec3(breadth, 1.0F, breadth);
  garment.computeNormals();
  return garment;
}

}  // namespace

raster::LitSurface makeFigure(float breadth) {
  Parts parts;
  parts.add(broadened(makeCloak(), breadth), kBody);
  parts.add(broadened(makeMantle(), breadth), kBody);
  parts.add(makeHood(), kBody);
  parts.add(makeFace(), kBody, kInTheHood);
  parts.add(makeLeftArm(), kBody);
  parts.addLegs(kLegs);
  parts.add(makeRightArm(), kArm);
  parts.add(makeLantern(), kArm);
  return parts.figure();
}

raster::LitSurface makeOwnFigure() {
  Parts parts;
  parts.addLegs(kOwnLegs);
  return parts.figure();
}

}  // namespace grove::objects::figure
