#include "raster/shading/detail.h"

#include "raster/shading/detail_kernels.h"

namespace grove::raster {
namespace {

using world::Vec3;

/// Metres per texel, coarse to fine.
constexpr std::array<float, kDetailScales> kTexel = {0.034F, 0.0071F, 0.0016F};
/// Change of the logarithm of the brightness by a full height, as stain and per unit of slope.
constexpr std::array<float, kDetailScales> kStain = {0.40F, 0.55F, 0.50F};
constexpr std::array<float, kDetailScales> kSlope = {1.05F, 1.10F, 0.90F};
/// The open sky lights relief from above where the sun does not.
constexpr float kSkyRelief = 0.50F;

/// Rotation and scale of a look-up: off the axes, where value noise would show its cells, and in texels.
glm::mat3 turnOf(std::size_t scale) {
  const glm::mat3 turn(0.36F, 0.48F, -0.80F, -0.80F, 0.60F, 0.00F, 0.48F, 0.64F, 0.60F);
  return (scale == 1 ? glm::transpose(turn) : turn) / kTexel[scale];
}

DetailScale scaleOf(std::size_t index, float focal, Vec3 sun, Vec3 up) {
  const glm::mat3 turn = turnOf(index);
  DetailScale scale;
  scale.texelX = Vec3(turn[0].x, turn[1].x, turn[2].x);
  scale.texelY = Vec3(turn[0].y, turn[1].y, turn[2].y);
  scale.texelZ = Vec3(turn[0].z, turn[1].z, turn[2].z);
  scale.sun = turn * sun * (kTexel[index] * kSlope[index] / 255.0F);
  scale.up = turn * up * (kTexel[index] * kSlope[index] * kSkyRelief / 255.0F);
  scale.stain = kStain[index] / 255.0F;
  scale.pixels = 1.8F * kTexel[index] * focal;
  return scale;
}

DetailView viewOf(const Drawing& drawing) {
  const world::Camera& camera = *drawing.camera;
  const world::Mat4 toObject = glm::inverse(drawing.bones[0]);
  const glm::mat3 turn(toObject);
  const float metre = glm::length(Vec3(drawing.bones[0][1]));  // the axis that slopes do not shear
  const auto rayAt = [&](int column, int row) {
    return turn * camera.ray(static_cast<float>(drawing.rect.left + column) + 0.5F,
                             static_cast<float>(drawing.rect.top + row) + 0.5F);
  };
  DetailView view;
  view.nearDepth = camera.nearDepth;
  view.eye = Vec3(toObject * world::Vec4(camera.pose.position, 1.0F));
  view.corner = rayAt(0, 0);
  view.alongRow = rayAt(1, 0) - view.corner;
  view.downwards = rayAt(0, 1) - view.corner;
  const Vec3 sun = turn * drawing.sky->sun * metre;
  const Vec3 up = turn * Vec3(0, 1, 0) * metre;
  for (std::size_t i = 0; i < kDetailScales; ++i) view.scales[i] = scaleOf(i, camera.focal() * metre, sun, up);
  return view;
}

}  // namespace

void finish(const Fragments& fragments, const Drawing& drawing, const DetailTexture& texture, Image& image) {
  image.spans.assign(fragments.spans.begin(), fragments.spans.end());
  if (drawing.object->surface.weathered) {
    finishWeathered(fragments, viewOf(drawing), texture.squares(), image);
  } else {
    finishPlain(fragments, drawing.camera->nearDepth, image);
  }
}

}  // namespace grove::raster
