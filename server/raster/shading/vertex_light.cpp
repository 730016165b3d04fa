#include "raster/shading/vertex_light.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "raster/shading/vertex_light_kernels.h"

namespace grove::raster {
namespace {

using world::Vec3;

BoneLight lightOf(const Drawing& drawing, const world::Mat4& bone) {
  const world::Mat4 toBone = glm::inverse(bone);
  const world::Sky& sky = *drawing.sky;
  BoneLight light;
  light.metre = glm::length(Vec3(bone[1]));  // the axis that slopes do not shear
  light.eye = Vec3(toBone * world::Vec4(drawing.camera->pose.position, 1.0F));
  const glm::mat3 turn = glm::mat3(toBone) * light.metre;
  light.sun = turn * sky.sun;
  light.sunColour = sky.sunColour;
  light.sunShare = drawing.sunShare;
  light.baked = drawing.object->baked;
  light.gloss = drawing.object->surface.gloss;
  light.up = turn * Vec3(0, 1, 0);
  // Ambient light is a polynomial of two cosines; three directions give its coefficients.
  const Vec3 level = sky.sun * Vec3(1, 0, 1);
  const Vec3 sunwards = glm::normalize(level);
  light.towardsGlow = (light.sun - light.up * sky.sun.y) / glm::length(level);
  light.ambient = sky.ambient(-sunwards);
  light.slope = 0.5F * (sky.ambient({0, 1, 0}) - sky.ambient({0, -1, 0}));
  light.glow = sky.ambient(sunwards) - light.ambient;
  light.lampCount = drawing.lamps.count;
  for (std::size_t i = 0; i < static_cast<std::size_t>(drawing.lamps.count); ++i) {
    light.lampPosition[i] = Vec3(toBone * world::Vec4(drawing.lamps.position[i], 1.0F));
    light.lampColour[i] = drawing.lamps.colour[i];
  }
  // Exponential in the distance, from the transmittance of a thousand metres.
  light.clearing = std::log(1.0F - world::hazeAmount(1000.0F)) / 1000.0F * light.metre;
  // The haze's glow is a polynomial of the cosine to the sun; two directions give its coefficients.
  light.haze = sky.hazeColour(-sky.sun);
  light.hazeGlow = (sky.hazeColour(sky.sun) - light.haze) / 0.66F;
  light.tintChange = drawing.tint - 1.0F;
  return light;
}

}  // namespace

void lightVertices(const VertexArrays& arrays, const Drawing& drawing, std::span<std::uint32_t> out) {
  std::array<std::optional<BoneLight>, kMaxBones> lights;  // of the bones that have vertices
  for (const VertexArrays::Run& run : arrays.runs) {
    const std::size_t end = std::min(run.end, out.size());
    if (run.begin >= end) continue;
    std::optional<BoneLight>& light = lights[run.bone];
    if (!light) light = lightOf(drawing, drawing.bones[run.bone]);
    lightRun(arrays, run.begin, end, *light, out.data());
  }
}

}  // namespace grove::raster
