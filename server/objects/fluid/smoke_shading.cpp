#include "objects/fluid/smoke_shading.h"

#include <algorithm>
#include <cmath>

namespace grove::objects::fluid {
namespace {

using world::Vec3;

inline float saturate(float value) { return std::min(1.0F, std::max(0.0F, value)); }

/// Henyey-Greenstein's phase function, 1 on average over the sphere.
inline float phase(float cosine, float g) {
  const float base = 1.0F + g * g - 2.0F * g * cosine;
  return (1.0F - g * g) / (base * std::sqrt(base));
}

}  // namespace

SmokeShading::SmokeShading() {
  for (std::size_t i = 0; i <= kSteps; ++i) {
    const float root = static_cast<float>(i) / static_cast<float>(kSteps);
    display_[i] = world::toDisplay(kBrightest * root * root);
  }
}

void SmokeShading::shade(const FluidSnapshot& snapshot, const world::Camera& camera,
                         std::span<const world::PointLight> lights, const SmokeDetail& detail, double time,
                         SmokeSprites& sprites) {
  scatter(snapshot, camera, sprites);
  for (const world::PointLight& light : lights) illuminate(snapshot, light, sprites);
  finish(snapshot, detail, static_cast<float>(std::fmod(time, 1000.0)), sprites);
}

void SmokeShading::scatter(const FluidSnapshot& snapshot, const world::Camera& camera, SmokeSprites& sprites) const {
  const Vec3 sun = world::sunDirection();
  const Vec3 sunColour = world::sunColour();
  const Vec3 sky = 0.75F * world::ambient({0.0F, 1.0F, 0.0F}) + 0.25F * world::ambient({0.0F, -1.0F, 0.0F});
  const Vec3 eye = camera.pose.position;
  const float* const px = snapshot.x.data();
  const float* const py = snapshot.y.data();
  const float* const pz = snapshot.z.data();
  const float* const skyLight = snapshot.skyLight.data();
  const float* const sunLight = snapshot.sunLight.data();
  float* const red = sprites.red.data();
  float* const green = sprites.green.data();
  float* const blue = sprites.blue.data();
  const std::size_t count = sprites.count;
#pragma GCC ivdep
  for (std::size_t i = 0; i < count; ++i) {
    const float dx = px[i] - eye.x;
    const float dy = py[i] - eye.y;
    const float dz = pz[i] - eye.z;
    const float cosine = (dx * sun.x + dy * sun.y + dz * sun.z) / std::sqrt(dx * dx + dy * dy + dz * dz + 1e-6F);
    // Most light goes on forwards; many scatterings in dense smoke make the rest even.
    const float bright = sunLight[i] * (0.26F + 0.15F * phase(cosine, 0.55F));
    const float dim = 0.25F + 0.75F * skyLight[i];
    red[i] = sunColour.r * bright + sky.r * dim;
    green[i] = sunColour.g * bright + sky.g * dim;
    blue[i] = sunColour.b * bright + sky.b * dim;
  }
}

void SmokeShading::illuminate(const FluidSnapshot& snapshot, const world::PointLight& light,
                              SmokeSprites& sprites) const {
  const Vec3 from = light.position;
  const Vec3 colour = light.colour;
  const float* const px = snapshot.x.data();
  const float* const py = snapshot.y.data();
  const float* const pz = snapshot.z.data();
  float* const red = sprites.red.data();
  float* const green = sprites.green.data();
  float* const blue = sprites.blue.data();
  const std::size_t count = sprites.count;
#pragma GCC ivdep
  for (std::size_t i = 0; i < count; ++i) {
    const float dx = px[i] - from.x;
    const float dy = py[i] - from.y;
    const float dz = pz[i] - from.z;
    // The flame is a body of half a metre, no point, and the smoke dims its own light with distance.
    const float square = dx * dx + dy * dy + dz * dz;
    const float reach = 0.14F / ((0.3F + square) * (1.0F + 0.15F * square));
    red[i] += colour.r * reach;
    green[i] += colour.g * reach;
    blue[i] += colour.b * reach;
  }
}

void SmokeShading::finish(const FluidSnapshot& snapshot, const SmokeDetail& detail, float time,
                          SmokeSprites& sprites) const {
  const float* const temperature = snapshot.temperature.data();
  const float* const heat = sprites.heat.data();
  const float* const life = sprites.life.data();
  const float* const fade = sprites.fade.data();
  const float* const shrink = sprites.shrink.data();
  const float* const radius = sprites.radius.data();
  const float* const rank = sprites.rank.data();
  const float* const chanceB = sprites.chanceB.data();
  const float* const chanceC = sprites.chanceC.data();
  const float* const display = display_.data();
  float* const red = sprites.red.data();
  float* const green = sprites.green.data();
  float* const blue = sprites.blue.data();
  float* const opacity = sprites.opacity.data();
  float* const softness = sprites.softness.data();
  const float share = detail.kept;
  const float denser = 1.0F / share;
  const auto encode = [display](float linear) {
    const float at = std::sqrt(saturate(linear * (1.0F / kBrightest))) * static_cast<float>(kSteps);
    return display[static_cast<int>(at)];
  };

  const std::size_t count = sprites.count;
#pragma GCC ivdep
  for (std::size_t i = 0; i < count; ++i) {
    const float hot = heat[i];
    const float grey = 1.0F - hot;
    // Soot first, pale later.
    const float albedo = (0.28F + 0.40F * std::sqrt(life[i])) * (0.85F + 0.3F * chanceC[i]);
    const float rest = 1.0F - life[i];
    // Hot gas is clear: what rises from the flames turns into smoke only above them.
    const float clear = 1.0F - 0.75F * saturate((temperature[i] - 0.1F) * 3.0F);
    const float thick =
        0.17F * clear * saturate(life[i] * 12.0F) * rest * std::sqrt(rest) * (0.55F + 0.9F * chanceB[i]);
    // Sprites at the edge of the kept share come and go softly; the kept ones stand for the others too.
    const float chosen = share >= 1.0F ? 1.0F : saturate((share * 1.05F - rank[i]) * 20.0F);
    const float dense = std::min(0.85F, thick * denser / (1.0F + 0.5F * thick * (denser - 1.0F)));
    const float smoke = grey * dense * chosen * fade[i] * shrink[i];

    const float beat = time * (2.0F + 2.0F * chanceC[i]) + 7.0F * chanceB[i];
    const float turn = beat - static_cast<float>(static_cast<int>(beat));
    const float flicker = 0.7F + 1.2F * turn * (1.0F - turn);
    const float glow = saturate((temperature[i] - 0.3F) * (1.0F / 0.7F));
    const float power = (0.6F + 3.4F * glow * glow) * flicker;
    const float flameRed = power;
    const float flameGreen = power * (0.05F + 0.23F * glow);
    const float flameBlue = power * (0.006F + 0.05F * glow * glow * glow);
    const float flame = hot * saturate(life[i] * 30.0F) * (0.08F + 0.13F * chanceB[i]) * flicker * fade[i] * shrink[i];

    red[i] = smoke * encode(albedo * red[i]) + flame * encode(flameRed);
    green[i] = smoke * encode(albedo * green[i] * 1.01F) + flame * encode(flameGreen);
    blue[i] = smoke * encode(albedo * blue[i] * 1.06F) + flame * encode(flameBlue);
    // Flame adds light and hides only some of what is behind it.
    opacity[i] = smoke + 0.6F * flame;
    softness[i] = 0.08F + 0.55F * radius[i];
  }
}

}  // namespace grove::objects::fluid
