#include "objects/sky/backend/clouds.h"

#include <algorithm>
#include <cmath>

#include "world/noise.h"

namespace grove::objects::sky {
namespace {

using world::Vec2;
using world::Vec3;

/// A layer of clouds is a flat sheet that the view ray crosses far away. `flatness` bounds that distance at the
/// horizon, as the earth's curvature does.
struct Layer {
  float flatness;
  Vec2 scale;       // features per unit of the sheet, along and across the wind
  float threshold;  // noise above which there is cloud
  float softness;
  float depth;  // rate at which light fades inside
  float max;    // cover of the thickest part
};

constexpr Layer kHigh{0.16F, {0.55F, 2.1F}, 0.50F, 0.34F, 1.1F, 0.55F};
constexpr Layer kLow{0.10F, {0.75F, 1.45F}, 0.545F, 0.17F, 3.4F, 0.96F};

float density(const Layer& layer, Vec2 at, float seed, int octaves) {
  const Vec2 bent = at + 0.45F * Vec2(world::noise(at * 1.3F + seed), world::noise(at * 1.3F + seed + 40.0F));
  const float n = world::fractalNoise(bent * layer.scale + seed, octaves);
  return glm::smoothstep(layer.threshold, layer.threshold + layer.softness, n);
}

CloudSample layerAt(const Layer& layer, const world::Sky& sky, Vec3 direction, float seed) {
  const float fade = glm::smoothstep(0.035F, 0.16F, direction.y);
  if (fade <= 0.0F) return {};
  const Vec3 sun = sky.sun;
  const Vec2 wind = glm::normalize(Vec2(0.86F, -0.5F));
  const Vec2 sheet = Vec2(direction.x, direction.z) / (direction.y + layer.flatness);
  const Vec2 at(glm::dot(sheet, wind), glm::dot(sheet, Vec2(-wind.y, wind.x)));
  const float here = density(layer, at, seed, 6);
  if (here <= 0.0F) return {};

  const Vec2 sunward = glm::normalize(Vec2(sun.x, sun.z));
  const Vec2 step(glm::dot(sunward, wind), glm::dot(sunward, Vec2(-wind.y, wind.x)));
  const float between = density(layer, at + step * 0.22F, seed, 4);
  const float lit = std::exp(-layer.depth * (0.55F * between + 0.45F * here * here));

  const float cosine = std::max(0.0F, glm::dot(direction, sun));
  const float forward = std::pow(cosine, 10.0F);
  const Vec3 bright = sky.sunColour * (0.62F + 1.15F * forward) + Vec3(0.05F, 0.04F, 0.05F);
  const Vec3 belly = glm::mix(Vec3(0.30F, 0.265F, 0.335F), Vec3(0.62F, 0.36F, 0.25F), std::pow(cosine, 3.0F));
  const Vec3 colour = glm::mix(belly, bright, lit);
  const float cover = layer.max * here * fade;
  // Clouds near the horizon are seen through much air.
  const float air = 0.75F * std::exp(-9.0F * direction.y);
  return {glm::mix(colour, sky.hazeColour(direction), air) * cover, cover};
}

}  // namespace

CloudSample cloudsAt(const world::Sky& sky, Vec3 direction, float seed) {
  const CloudSample high = layerAt(kHigh, sky, direction, seed);
  const CloudSample low = layerAt(kLow, sky, direction, seed + 91.7F);
  return {high.light * (1.0F - low.cover) + low.light, high.cover * (1.0F - low.cover) + low.cover};
}

}  // namespace grove::objects::sky
