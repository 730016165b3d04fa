#include "objects/fluid/frontend/smoke_shading_kernels.h"

#include <algorithm>
#include <cmath>

#include "base/simd/loops.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "objects/fluid/frontend/smoke_shading_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "base/simd/lanes_inl.h"
#include "objects/fluid/common/load_partial_inl.h"

HWY_BEFORE_NAMESPACE();
namespace grove::objects::fluid::HWY_NAMESPACE {

using namespace simd::HWY_NAMESPACE;
using world::Vec3;

/// Henyey-Greenstein's phase function, 1 on average over the sphere.
HWY_INLINE float phase(float cosine, float g) {
  const float base = 1.0F + g * g - 2.0F * g * cosine;
  return (1.0F - g * g) / (base * std::sqrt(base));
}

void scatterSunAndSky(const FluidSnapshot& snapshot, world::Vec3 eye, world::Vec3 sun, world::Vec3 sunColour,
                      const SmokeSky& sky, SmokeSprites& sprites) {
  const float* const px = snapshot.x.data();
  const float* const py = snapshot.y.data();
  const float* const pz = snapshot.z.data();
  const float* const skyLight = snapshot.skyLight.data();
  const float* const sunLight = snapshot.sunLight.data();
  float* const red = sprites.red.data();
  float* const green = sprites.green.data();
  float* const blue = sprites.blue.data();
  const auto [above, side] = sky;
  const std::size_t count = sprites.count;
  GROVE_INDEPENDENT_ITERATIONS
  for (std::size_t i = 0; i < count; ++i) {
    const float dx = px[i] - eye.x;
    const float dy = py[i] - eye.y;
    const float dz = pz[i] - eye.z;
    const float cosine = (dx * sun.x + dy * sun.y + dz * sun.z) / std::sqrt(dx * dx + dy * dy + dz * dz + 1e-6F);
    // The sun's own ray scatters forwards. Light that smoke has scattered before comes from everywhere, and in dense
    // smoke there is no other.
    const float bright = sunLight[i] * (0.26F + 0.3F * sunLight[i] * phase(cosine, 0.55F));
    red[i] = sunColour.r * bright + side.r + above.r * skyLight[i];
    green[i] = sunColour.g * bright + side.g + above.g * skyLight[i];
    blue[i] = sunColour.b * bright + side.b + above.b * skyLight[i];
  }
}

void addPointLight(const FluidSnapshot& snapshot, const world::PointLight& light, SmokeSprites& sprites) {
  const Vec3 from = light.position;
  const Vec3 colour = light.colour;
  const float* const px = snapshot.x.data();
  const float* const py = snapshot.y.data();
  const float* const pz = snapshot.z.data();
  float* const red = sprites.red.data();
  float* const green = sprites.green.data();
  float* const blue = sprites.blue.data();
  const std::size_t count = sprites.count;
  GROVE_INDEPENDENT_ITERATIONS
  for (std::size_t i = 0; i < count; ++i) {
    const float dx = px[i] - from.x;
    const float dy = py[i] - from.y;
    const float dz = pz[i] - from.z;
    const float square = dx * dx + dy * dy + dz * dz;
    // The flame is a body of half a metre, not a point. Smoke rises from it, so the way up is full of smoke; light
    // that comes across, as a lantern's, comes through air.
    const float up = dy > 0.0F ? dy : 0.0F;
    const float thick = 1.0F + 0.5F * up * up;
    const float reach = 0.14F / ((0.3F + square) * (1.0F + 0.15F * square) * thick * thick);
    red[i] += colour.r * reach;
    green[i] += colour.g * reach;
    blue[i] += colour.b * reach;
  }
}

/// Looks up display values of linear radiances, one by one (base/simd/look_up_inl.h explains why).
HWY_INLINE Floats encode(const float* display, Floats linear) {
  const Floats root = sqrt(clamp(linear * Floats(1.0F / kBrightestSmoke), Floats(0.0F), Floats(1.0F)));
  alignas(64) std::int32_t at[kLanes];
  alignas(64) float found[kLanes];
  store(truncate(root * Floats(static_cast<float>(kDisplaySteps))), at);
  for (int lane = 0; lane < kLanes; ++lane) found[lane] = display[at[lane]];
  return load(found);
}

HWY_INLINE Floats saturate(Floats value) { return clamp(value, Floats(0.0F), Floats(1.0F)); }

/// Finishes kLanes sprites.
struct Finish {
  const FluidSnapshot& snapshot;
  const float kept;
  const float time;
  const float* const display;

  HWY_INLINE void operator()(SmokeSprites& sprites, std::size_t i) const {
    const auto at = [i](const std::vector<float>& values) { return load(values.data() + i); };
    const Floats one(1.0F);
    const Floats temperature = loadPartial(snapshot.temperature.data(), i, snapshot.temperature.size());
    const Floats hot = at(sprites.heat);
    const Floats life = at(sprites.life);
    const Floats chanceB = at(sprites.chanceB);
    const Floats chanceC = at(sprites.chanceC);
    const Floats visible = at(sprites.fade) * at(sprites.shrink);
    // Young smoke is sooty, old smoke pale.
    const Floats albedo = (Floats(0.28F) + Floats(0.40F) * sqrt(life)) * (Floats(0.85F) + Floats(0.3F) * chanceC);
    const Floats rest = one - life;
    // Hot gas is clear: smoke becomes visible only above the flames.
    const Floats clear = one - Floats(0.75F) * saturate((temperature - Floats(0.1F)) * Floats(3.0F));
    const Floats thick = Floats(0.115F) * clear * saturate(life * Floats(12.0F)) * rest * sqrt(rest) *
                         (Floats(0.55F) + Floats(0.9F) * chanceB);
    // Sprites at the edge of the kept share fade in and out; the kept ones replace the dropped ones.
    const Floats chosen = kept >= 1.0F ? one : saturate((Floats(kept * 1.05F) - at(sprites.rank)) * Floats(20.0F));
    const float denser = 1.0F / kept;
    const Floats dense = min(Floats(0.85F), thick * Floats(denser) / (one + Floats(0.5F * (denser - 1.0F)) * thick));
    const Floats smoke = (one - hot) * dense * chosen * visible;
    Floats red = smoke * encode(display, albedo * at(sprites.red));
    Floats green = smoke * encode(display, albedo * at(sprites.green) * Floats(1.01F));
    Floats blue = smoke * encode(display, albedo * at(sprites.blue) * Floats(1.06F));
    Floats opacity = smoke;
    // Flames are few and close together.
    if (any(hot > Floats(0.0F))) {
      const Floats beat = Floats(time) * (Floats(2.0F) + Floats(2.0F) * chanceC) + Floats(7.0F) * chanceB;
      const Floats turn = beat - floor(beat);
      const Floats flicker = Floats(0.7F) + Floats(1.2F) * turn * (one - turn);
      const Floats glow = saturate((temperature - Floats(0.3F)) * Floats(1.0F / 0.7F));
      const Floats power = (Floats(0.6F) + Floats(3.4F) * glow * glow) * flicker;
      const Floats flame =
          hot * saturate(life * Floats(30.0F)) * (Floats(0.08F) + Floats(0.13F) * chanceB) * flicker * visible;
      red += flame * encode(display, power);
      green += flame * encode(display, power * (Floats(0.05F) + Floats(0.23F) * glow));
      blue += flame * encode(display, power * (Floats(0.006F) + Floats(0.05F) * glow * glow * glow));
      // Flame adds light and hides only part of the background.
      opacity += Floats(0.6F) * flame;
    }
    const Floats ember = at(sprites.ember);
    const Mask glowing = ember > Floats(0.0F);
    if (any(glowing)) {
      const Floats covers = min(one, Floats(2.5F) * ember) * at(sprites.fade) * sqrt(at(sprites.shrink));
      const Floats power = mulAdd(Floats(3.0F), ember, one);
      red = select(glowing, covers * encode(display, power), red);
      green = select(glowing, covers * encode(display, power * Floats(0.14F)), green);
      blue = select(glowing, covers * encode(display, power * Floats(0.02F)), blue);
      opacity = select(glowing, Floats(0.5F) * covers, opacity);
    }
    store(red, sprites.red.data() + i);
    store(green, sprites.green.data() + i);
    store(blue, sprites.blue.data() + i);
    store(opacity, sprites.opacity.data() + i);
    store(Floats(0.08F) + Floats(0.55F) * at(sprites.radius), sprites.softness.data() + i);
  }
};

void finishSprites(const FluidSnapshot& snapshot, float kept, float time, const float* display, SmokeSprites& sprites) {
  const Finish finish{snapshot, kept, time, display};
  for (std::size_t i = 0; i < sprites.count; i += static_cast<std::size_t>(kLanes)) finish(sprites, i);
}

}  // namespace grove::objects::fluid::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace grove::objects::fluid {

HWY_EXPORT(scatterSunAndSky);
HWY_EXPORT(addPointLight);
HWY_EXPORT(finishSprites);

void scatterSunAndSky(const FluidSnapshot& snapshot, world::Vec3 eye, world::Vec3 sun, world::Vec3 sunColour,
                      const SmokeSky& sky, SmokeSprites& sprites) {
  HWY_DYNAMIC_DISPATCH(scatterSunAndSky)(snapshot, eye, sun, sunColour, sky, sprites);
}

void addPointLight(const FluidSnapshot& snapshot, const world::PointLight& light, SmokeSprites& sprites) {
  HWY_DYNAMIC_DISPATCH(addPointLight)(snapshot, light, sprites);
}

void finishSprites(const FluidSnapshot& snapshot, float kept, float time, const float* display, SmokeSprites& sprites) {
  HWY_DYNAMIC_DISPATCH(finishSprites)(snapshot, kept, time, display, sprites);
}

}  // namespace grove::objects::fluid

#endif  // HWY_ONCE
