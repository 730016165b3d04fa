#include "objects/sky/backend/panorama_bake.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "objects/sky/backend/clouds.h"
#include "objects/sky/backend/landscape.h"
#include "world/light.h"
#include "world/noise.h"

namespace grove::objects::sky {
namespace {

using world::Vec3;

constexpr float kSunRadius = 0.0105F;        // radians, twice the real one, as seen through a camera's lens
constexpr float kLandscapeTangent = 0.125F;  // upper bound of the landscape

Vec3 sunAt(Vec3 sun, Vec3 direction) {
  const float angle = std::acos(std::clamp(glm::dot(direction, sun), -1.0F, 1.0F));
  const float disc = 1.0F - glm::smoothstep(kSunRadius * 0.85F, kSunRadius * 1.15F, angle);
  const float halo = 0.55F * std::exp(-angle / 0.030F) + 0.30F * std::exp(-angle / 0.11F);
  return Vec3(26.0F, 17.0F, 8.0F) * disc + Vec3(2.6F, 1.45F, 0.62F) * halo;
}

std::uint32_t dithered(Vec3 linear, int column, int row) {
  std::uint32_t rgba = 0xFF000000U;
  for (int channel = 0; channel < 3; ++channel) {
    const float level = world::toDisplay(linear[channel]) * 255.0F + world::hashUnit(column, row, channel);
    rgba |= static_cast<std::uint32_t>(std::clamp(level, 0.0F, 255.0F)) << (8U * static_cast<unsigned>(channel));
  }
  return rgba;
}

}  // namespace

Panorama bakePanorama(PanoramaSize size, int seed, const world::Sky& sky, const std::function<void(float)>& progress) {
  Panorama panorama(size);
  const auto salt = static_cast<float>(seed % 1000) * 3.7F;
  std::vector<Skyline> skylines;
  skylines.reserve(static_cast<std::size_t>(size.width));
  for (int column = 0; column < size.width; ++column) skylines.push_back(skylineAt(panorama.heading(column), salt));

  for (int row = 0; row < size.height; ++row) {
    const float tangent = panorama.tangent(row);
    const float step = std::max(1e-4F, panorama.tangent(std::min(row + 1, size.height - 1)) - tangent);
    for (int column = 0; column < size.width; ++column) {
      const float heading = panorama.heading(column);
      const Vec3 direction = Panorama::direction(heading, tangent);
      const CloudSample clouds = cloudsAt(sky, direction, salt);
      const Vec3 sun = sunAt(sky.sun, direction);
      // Thin cloud shows the disc, thick cloud keeps its glow.
      Vec3 colour =
          (sky.radiance(direction) + sun) * (1.0F - clouds.cover) + clouds.light + sun * (0.10F * clouds.cover);
      if (tangent < kLandscapeTangent) {
        const Skyline& skyline = skylines[static_cast<std::size_t>(column)];
        colour = landscapeOver(sky, colour, skyline, direction, heading, tangent, step, salt);
        // The lens spreads the sun's glow over the landscape in front of it.
        colour += Vec3(0.50F, 0.26F, 0.09F) * std::pow(std::max(0.0F, glm::dot(direction, sky.sun)), 40.0F) *
                  (1.0F - glm::smoothstep(0.0F, kLandscapeTangent, tangent));
      }
      panorama.set(column, row, dithered(colour, column, row));
    }
    progress(static_cast<float>(row + 1) / static_cast<float>(size.height));
  }
  return panorama;
}

}  // namespace grove::objects::sky
