#include "objects/sky/backend/landscape.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "world/light.h"
#include "world/noise.h"

namespace grove::objects::sky {
namespace {

using world::Vec2;
using world::Vec3;

struct Ridge {
  float base;      // lowest tangent of elevation
  float relief;    // added by hills
  float features;  // approximate number of hills around the circle
  float treeTop;   // height of a tree; 0: too distant for single trees
  int trees;       // around the circle
  float distance;  // metres, for haze
  Vec3 albedo;
};

const std::array<Ridge, kRidges> kRidge = {{
    {0.030F, 0.066F, 5.0F, 0.0F, 1, 900.0F, {0.10F, 0.12F, 0.15F}},
    {0.020F, 0.050F, 8.0F, 0.0F, 1, 560.0F, {0.08F, 0.11F, 0.11F}},
    {0.012F, 0.036F, 12.0F, 0.0050F, 2600, 360.0F, {0.07F, 0.10F, 0.08F}},
    {0.006F, 0.024F, 17.0F, 0.012F, 1700, 230.0F, {0.065F, 0.095F, 0.055F}},
    {0.001F, 0.014F, 23.0F, 0.026F, 900, 140.0F, {0.060F, 0.085F, 0.040F}},
    {0.003F, 0.008F, 9.0F, 0.050F, 640, 85.0F, {0.055F, 0.075F, 0.032F}},
}};

/// Tangent of elevation at which the meadow's mist ends, on average.
constexpr float kMistTop = 0.026F;
/// At the horizon, where the ground is seen through as much air and mist.
constexpr float kMist = 0.95F;

/// Seamless noise around the circle.
float around(float heading, float features, float seed) {
  const float radius = features * 0.5F * std::numbers::inv_pi_v<float> * 2.0F;
  return world::fractalNoise(Vec3(std::cos(heading) * radius, std::sin(heading) * radius, seed), 4);
}

/// Share of mist before the landscape, whose top is ragged.
float mistAt(float heading, float tangent, float top, float seed) {
  const Vec3 place(std::cos(heading) * 9.0F, std::sin(heading) * 9.0F, tangent * 90.0F + seed + 37.0F);
  const float wisps = 1.6F * top * (world::fractalNoise(place, 4) - 0.5F);
  const float height = tangent + wisps * glm::smoothstep(0.0F, 0.5F * top, tangent);
  return kMist * (1.0F - glm::smoothstep(0.0F, top, height));
}

/// Outline of one tree: 0..1 at `x` in -1..1 across it. Firs are cones with ragged boughs, the others round crowns.
float outline(float x, bool fir, std::int32_t key) {
  const float away = std::fabs(x);
  if (away >= 1.0F) return 0.0F;
  const float ragged = world::noise(Vec2(x * 7.0F, static_cast<float>(key & 1023)));
  const float boughs = away * 6.0F - std::floor(away * 6.0F);
  if (fir) return std::pow(1.0F - away, 1.15F) * (0.84F + 0.16F * ragged) + 0.055F * boughs;
  return std::sqrt(1.0F - away * away) * (0.66F + 0.34F * ragged);
}

/// Tangent that a line of trees adds to the land.
float treesAt(float heading, const Ridge& ridge, std::int32_t salt) {
  const float place = heading * 0.5F * std::numbers::inv_pi_v<float> * static_cast<float>(ridge.trees);
  const auto cell = static_cast<std::int32_t>(std::floor(place));
  float top = 0.0F;
  for (std::int32_t i = cell - 2; i <= cell + 2; ++i) {
    const std::int32_t tree = (i % ridge.trees + ridge.trees) % ridge.trees;
    const float middle = static_cast<float>(i) + world::hashUnit(tree, salt, 1);
    const bool fir = world::hashUnit(tree / 9, salt, 2) < 0.55F;
    // Most trees are young, and a few stand out.
    const float age = world::hashUnit(tree, salt, 3);
    const float tall = fir ? 0.35F + 0.75F * age * age : 0.38F + 0.42F * age;
    const float half = (fir ? 0.5F + 0.5F * tall : 1.5F) * (0.75F + 0.5F * world::hashUnit(tree, salt, 4));
    top = std::max(top, tall * outline((place - middle) / half, fir, tree));
  }
  return top * ridge.treeTop;
}

}  // namespace

Skyline skylineAt(float heading, float seed) {
  Skyline skyline;
  const float bank = glm::smoothstep(0.3F, 0.7F, around(heading, 11.0F, seed + 71.0F));
  skyline.mistTop = kMistTop * (0.4F + 1.2F * bank);
  for (std::size_t i = 0; i < kRidges; ++i) {
    const Ridge& ridge = kRidge[i];
    const float salt = seed + 13.0F * static_cast<float>(i);
    const float hills = glm::smoothstep(0.25F, 0.80F, around(heading, ridge.features, salt));
    skyline.tops[i] = ridge.base + ridge.relief * hills;
    if (ridge.treeTop > 0.0F) {
      const float grove = glm::smoothstep(0.32F, 0.55F, around(heading, ridge.features * 2.7F, salt + 5.0F));
      const float trees = treesAt(heading, ridge, static_cast<std::int32_t>(i) * 977 + static_cast<std::int32_t>(seed));
      skyline.tops[i] += trees * (0.22F + 0.78F * grove);
    }
  }
  return skyline;
}

Vec3 landscapeOver(const world::Sky& sky, Vec3 behind, const Skyline& skyline, Vec3 direction, float heading,
                   float tangent, float texel, float seed) {
  const Vec3 haze = sky.hazeColour(direction);
  const float meadowMist = mistAt(heading, tangent, skyline.mistTop, seed);
  // Surfaces face the viewer, so they are lit if the sun is behind the viewer.
  const Vec3 sun = sky.sun;
  const float facing =
      0.5F - 0.5F * glm::dot(glm::normalize(Vec2(direction.x, direction.z)), glm::normalize(Vec2(sun.x, sun.z)));
  Vec3 colour = behind;
  for (std::size_t i = 0; i < kRidges; ++i) {
    const Ridge& ridge = kRidge[i];
    const float below = skyline.tops[i] - tangent;
    const float cover = std::clamp(below / texel + 0.5F, 0.0F, 1.0F);
    if (cover <= 0.0F) continue;
    const float grain = ridge.treeTop > 0.0F ? 1.0F / ridge.treeTop : 60.0F;
    const float leaves = world::fractalNoise(
        Vec3(std::cos(heading) * grain * 2.0F, std::sin(heading) * grain * 2.0F, tangent * grain * 2.2F + seed), 3);
    const Vec3 light = sky.ambient(Vec3(0.0F, 0.35F, 0.0F)) + sky.sunColour * (0.85F * facing * facing);
    const Vec3 surface = ridge.albedo * light * (0.35F + 1.3F * leaves);
    // Mist fills the hollows and the meadow's far end, where the ground's renderer applies the same mist.
    const float hollow =
        0.12F * std::exp(-std::max(0.0F, tangent) / (0.004F + 0.22F * std::max(0.0F, skyline.tops[i])));
    const float mist = std::max(hollow, meadowMist);
    const float air = 1.0F - (1.0F - world::hazeAmount(ridge.distance)) * (1.0F - mist);
    colour = glm::mix(colour, glm::mix(surface, haze, air), cover);
  }
  return colour;
}

}  // namespace grove::objects::sky
