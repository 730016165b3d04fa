#include "objects/ground/frontend/soil_kernels.h"

#include <algorithm>
#include <cmath>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "objects/ground/frontend/soil_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

// After the line that includes this file once per target.
#include <hwy/contrib/math/math-inl.h>

#include "base/simd/lanes_inl.h"

HWY_BEFORE_NAMESPACE();
namespace grove::objects::ground::HWY_NAMESPACE {
namespace {

namespace lanes = grove::simd::HWY_NAMESPACE;
namespace hn = hwy::HWY_NAMESPACE;
using lanes::Floats;
using lanes::Ints;
using lanes::kLanes;

struct Albedo {
  float r, g, b;
};
constexpr Albedo kLush{0.105F, 0.172F, 0.045F};
constexpr Albedo kDry{0.215F, 0.208F, 0.076F};
constexpr Albedo kEarth{0.250F, 0.165F, 0.100F};

/// Nodes where the parabola meets the tone curve: square roots of albedo relative to the soil's, from shaded stalks to
/// lit tips.
constexpr float kDark = 0.40F;
constexpr float kMiddle = 0.85F;
constexpr float kBright = 1.40F;

/// Values that the samples of a row share.
struct SoilRow {
  float firstSide, sideStep;
  float towards, towardsSide, inverseSunFlat;  // the sun's direction
  float lengthSquare;                          // of the ray without its sideways part
};

SoilRow soilRowOf(const Frame& frame, const GroundRow& row, int firstColumn, const GroundLight& light) {
  const world::Vec3 sun = light.sun;
  return {.firstSide = frame.firstSide + static_cast<float>(firstColumn) * frame.sideStep,
          .sideStep = frame.sideStep * kCoarse,
          .towards = sun.x * row.ahead * frame.forwardX + sun.z * row.ahead * frame.forwardZ + sun.y * row.rise,
          .towardsSide = sun.x * frame.sideX + sun.z * frame.sideZ,
          .inverseSunFlat = 1.0F / std::sqrt(sun.x * sun.x + sun.z * sun.z),
          .lengthSquare = row.ahead * row.ahead + row.rise * row.rise};
}

/// Share of the ground's colour that mist leaves, see world::mistAmount().
HWY_INLINE Floats withoutMist(Floats distance) {
  constexpr float kPerMetre = 1.0F / (world::kMistIsThickest - world::kMistBegins);
  const Floats share = lanes::clamp((distance - world::kMistBegins) * kPerMetre, 0.0F, 1.0F);
  return Floats(1.0F) - share * share * (Floats(3.0F) - share * 2.0F) * world::kMostMist;
}

/// One mip level.
struct Texels {
  const std::uint32_t* texels;
  int size;
  float perMetre;
};

struct Colours {
  Floats r, g, b;
};

/// Light of the lamps at the points x, z.
HWY_INLINE Colours lampLight(std::span<const world::PointLight> lights, Floats x, Floats z) {
  Colours sum;
  for (const world::PointLight& lamp : lights) {
    const float up = lamp.position.y;
    const Floats dx = Floats(lamp.position.x) - x;
    const Floats dz = Floats(lamp.position.z) - z;
    const Floats away = dx * dx + dz * dz + (up * up + 0.05F);
    // Upright grass catches light that the plane would not.
    const Floats strength = (Floats(0.35F) + Floats(0.65F * up) / lanes::sqrt(away)) / away;
    sum.r += Floats(lamp.colour.r) * strength;
    sum.g += Floats(lamp.colour.g) * strength;
    sum.b += Floats(lamp.colour.b) * strength;
  }
  return sum;
}

/// Four texels around a place, and the weights of the right and lower ones.
struct Corners {
  Ints topLeft, topRight, bottomLeft, bottomRight;
  Floats right, down;

  /// One channel, interpolated, as 0..1.
  template <int kShift>
  HWY_INLINE Floats channel() const {
    const auto of = [](Ints texel) { return lanes::toFloats(lanes::shiftRight<kShift>(texel) & Ints(0xFF)); };
    const Floats a = of(topLeft);
    const Floats c = of(bottomLeft);
    const Floats top = a + (of(topRight) - a) * right;
    const Floats bottom = c + (of(bottomRight) - c) * right;
    return (top + (bottom - top) * down) * (1.0F / 255.0F);
  }
};

HWY_INLINE Corners cornersAt(const Texels& level, Floats x, Floats z) {
  const Floats middle = 0.5F * static_cast<float>(level.size) - 0.5F;
  const Floats last = static_cast<float>(level.size - 1) - 0.001F;
  const Floats column = lanes::clamp(x * level.perMetre + middle, 0.0F, last);
  const Floats row = lanes::clamp(z * level.perMetre + middle, 0.0F, last);
  const Ints left = lanes::truncate(column);
  const Ints top = lanes::truncate(row);
  // Single loads: there are few, and no two samples share them.
  HWY_ALIGN std::int32_t at[kLanes];
  HWY_ALIGN std::uint32_t texels[4][kLanes];
  lanes::store(top * Ints(level.size) + left, at);
  for (int lane = 0; lane < kLanes; ++lane) {
    const std::uint32_t* const from = level.texels + at[lane];
    texels[0][lane] = from[0];
    texels[1][lane] = from[1];
    texels[2][lane] = from[level.size];
    texels[3][lane] = from[level.size + 1];
  }
  return {lanes::load(texels[0]), lanes::load(texels[1]),         lanes::load(texels[2]),
          lanes::load(texels[3]), column - lanes::toFloats(left), row - lanes::toFloats(top)};
}

/// Displayed value of blades with the square root of albedo `root`.
HWY_INLINE Floats shown(Floats radiance, Floats haze, float root, const float* HWY_RESTRICT levels) {
  const Floats entry = (haze + radiance * (root * root)) * ToneTable::kScale;
  HWY_ALIGN std::int32_t at[kLanes];
  HWY_ALIGN float level[kLanes];
  lanes::store(lanes::truncate(lanes::min(entry, static_cast<float>(ToneTable::kEntries - 1))), at);
  for (int lane = 0; lane < kLanes; ++lane) level[lane] = levels[at[lane]];
  return lanes::load(level);
}

/// Fits the parabola of the displayed value to radiance and haze.
HWY_INLINE void develop(Floats radiance, Floats haze, const float* HWY_RESTRICT levels, SampledSoil::Channel& out,
                        int first) {
  const Floats dark = shown(radiance, haze, kDark, levels);
  const Floats middle = shown(radiance, haze, kMiddle, levels);
  const Floats bright = shown(radiance, haze, kBright, levels);
  const Floats toMiddle = (middle - dark) * (1.0F / (kMiddle - kDark));
  const Floats toBright = (bright - middle) * (1.0F / (kBright - kMiddle));
  const Floats square = (toBright - toMiddle) * (1.0F / (kBright - kDark));
  const Floats slope = toMiddle - square * (kDark + kMiddle);
  lanes::store(square, out.square.data() + first);
  lanes::store(slope, out.slope.data() + first);
  lanes::store(dark - (slope + square * kDark) * kDark + 0.5F, out.base.data() + first);
}

HWY_INLINE void sampleAt(const SoilRow& row, const GroundRow& ground, const Texels& level, const GroundLight& light,
                         std::span<const world::PointLight> lights, int first, SampledSoil& out) {
  const Floats side = lanes::toFloats(lanes::upwards() + Ints(first)) * row.sideStep + row.firstSide;
  const Floats x = lanes::load(ground.litX.data() + first);
  const Floats z = lanes::load(ground.litZ.data() + first);
  const Floats depth = lanes::load(ground.litDepth.data() + first);
  const Colours lamps = lampLight(lights, x, z);
  const Corners corners = cornersAt(level, x, z);
  const Floats lit = corners.channel<0>();
  const Floats open = corners.channel<8>();
  const Floats dry = corners.channel<16>();
  const Floats grass = corners.channel<24>();

  const Floats length = lanes::sqrt(side * side + row.lengthSquare);
  const Floats ray = (side * row.towardsSide + row.towards) / length;
  const Floats cosine = lanes::max(0.0F, ray);
  const Floats c2 = cosine * cosine;
  const Floats c4 = c2 * c2;
  const Floats c8 = c4 * c4;
  const Floats c16 = c8 * c8;
  const Floats cover = lanes::min(1.0F, grass * 4.0F);
  // Blades transmit light when seen against the sun, and reflect it dully when seen with the sun behind the eye.
  const Floats away = Floats(0.5F) - ray * (0.5F * row.inverseSunFlat);
  const Floats direct = lit * (cover * (away * 0.42F + c4 * 1.05F + c16 * 0.85F + 0.14F) + 0.26F);
  const Floats shade = open * open * (Floats(1.0F) - cover * 0.15F);
  const Floats r = cover * (dry * (kDry.r - kLush.r) + (kLush.r - kEarth.r)) + kEarth.r;
  const Floats g = cover * (dry * (kDry.g - kLush.g) + (kLush.g - kEarth.g)) + kEarth.g;
  const Floats b = cover * (dry * (kDry.b - kLush.b) + (kLush.b - kEarth.b)) + kEarth.b;
  const Floats through =
      Floats(hn::Exp(lanes::FloatTag(), (length * depth * light.logTransmittance).raw)) * withoutMist(depth);
  const Floats glow = (c4 * 0.36F + c16 * 0.30F) * (1.0F / 0.66F);
  const Floats air = Floats(1.0F) - through;

  const float* HWY_RESTRICT levels = light.tone.levels.data();
  const auto channel = [&](Floats albedo, float sun, float sky, Floats lamp, float aside, float glows, int index) {
    const Floats radiance = through * albedo * (direct * sun + shade * sky + lamp);
    const Floats haze = air * (glow * glows + aside);
    develop(radiance, haze, levels, out.channels[static_cast<std::size_t>(index)], first);
  };
  channel(r, light.sunColour.r, light.ambient.r, lamps.r, light.hazeAside.r, light.hazeGlow.r, 0);
  channel(g, light.sunColour.g, light.ambient.g, lamps.g, light.hazeAside.g, light.hazeGlow.g, 1);
  channel(b, light.sunColour.b, light.ambient.b, lamps.b, light.hazeAside.b, light.hazeGlow.b, 2);
  lanes::store(grass, out.grass.data() + first);
}

void sampleSoil(const Frame& frame, const GroundRow& ground, int firstColumn, const Clearing& clearing, int level,
                const GroundLight& light, std::span<const world::PointLight> lights, SampledSoil& out) {
  const int size = clearing.pyramid.size() >> level;
  const Texels texels{clearing.pyramid.level(level), size, static_cast<float>(size) / clearing.metres};
  const SoilRow soilRow = soilRowOf(frame, ground, firstColumn, light);
  for (int first = 0; first < kCoarsePadded; first += kLanes) {
    sampleAt(soilRow, ground, texels, light, lights, first, out);
  }
}

}  // namespace
}  // namespace grove::objects::ground::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace grove::objects::ground {

HWY_EXPORT(sampleSoil);

void sampleSoil(const Frame& frame, const GroundRow& ground, int firstColumn, const Clearing& clearing, int level,
                const GroundLight& light, std::span<const world::PointLight> lights, SampledSoil& out) {
  HWY_DYNAMIC_DISPATCH(sampleSoil)
  (frame, ground, firstColumn, clearing, level, light, lights, out);
}

}  // namespace grove::objects::ground

#endif  // HWY_ONCE
