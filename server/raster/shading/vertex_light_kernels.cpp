#include "raster/shading/vertex_light_kernels.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "raster/shading/vertex_light.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "raster/shading/vertex_light_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace grove::raster::HWY_NAMESPACE {

using world::Vec3;

constexpr std::size_t kBlock = 256;

/// Irradiance without the sun's, as a white surface reflects it.
struct Indirect {
  float r[kBlock];
  float g[kBlock];
  float b[kBlock];
};

HWY_INLINE void addLamp(const VertexArrays& v, std::size_t first, std::size_t count, Vec3 at, Vec3 colour, float metre,
                        Indirect& indirect) {
  const float* __restrict px = v.positionX.data() + first;
  const float* __restrict py = v.positionY.data() + first;
  const float* __restrict pz = v.positionZ.data() + first;
  const float* __restrict nx = v.normalX.data() + first;
  const float* __restrict ny = v.normalY.data() + first;
  const float* __restrict nz = v.normalZ.data() + first;
  const float squareMetre = metre * metre;
  for (std::size_t i = 0; i < count; ++i) {
    const float x = at.x - px[i];
    const float y = at.y - py[i];
    const float z = at.z - pz[i];
    const float squared = x * x + y * y + z * z + 1.0e-6F;
    const float cosine = (nx[i] * x + ny[i] * y + nz[i] * z) / std::sqrt(squared);
    const float share = std::max(0.0F, (cosine + 0.15F) / 1.15F) / (squared * squareMetre + 0.02F);
    indirect.r[i] += colour.r * share;
    indirect.g[i] += colour.g * share;
    indirect.b[i] += colour.b * share;
  }
}

HWY_INLINE void copy(const VertexArrays& v, std::size_t first, std::size_t count, Indirect& indirect) {
  const float* __restrict r = v.indirectR.data() + first;
  const float* __restrict g = v.indirectG.data() + first;
  const float* __restrict b = v.indirectB.data() + first;
  for (std::size_t i = 0; i < count; ++i) {
    indirect.r[i] = r[i];
    indirect.g[i] = g[i];
    indirect.b[i] = b[i];
  }
}

HWY_INLINE void addAmbient(const VertexArrays& v, std::size_t first, std::size_t count, const BoneLight& light,
                           Indirect& indirect) {
  const Vec3 up = light.up;
  const Vec3 towards = light.towardsGlow;
  const Vec3 ambient = light.ambient;
  const Vec3 slope = light.slope;
  const Vec3 glow = light.glow;
  const float* __restrict nx = v.normalX.data() + first;
  const float* __restrict ny = v.normalY.data() + first;
  const float* __restrict nz = v.normalZ.data() + first;
  const float* __restrict r = v.indirectR.data() + first;
  const float* __restrict g = v.indirectG.data() + first;
  const float* __restrict b = v.indirectB.data() + first;
  for (std::size_t i = 0; i < count; ++i) {
    const float rise = nx[i] * up.x + ny[i] * up.y + nz[i] * up.z;
    const float near = 0.5F + 0.5F * (nx[i] * towards.x + ny[i] * towards.y + nz[i] * towards.z);
    indirect.r[i] = r[i] * (ambient.r + slope.r * rise + glow.r * near * near);
    indirect.g[i] = g[i] * (ambient.g + slope.g * rise + glow.g * near * near);
    indirect.b[i] = b[i] * (ambient.b + slope.b * rise + glow.b * near * near);
  }
}

/// Accurate to 3e-6, for x <= 0. Without branches and calls, so that it vectorises everywhere.
HWY_INLINE float exponential(float x) {
  const float doublings = std::max(x * 1.44269504F, -126.0F);
  const float whole = std::floor(doublings + 0.5F);
  const float f = doublings - whole;
  const float rest =
      1.0F + f * (0.693147181F + f * (0.240226507F + f * (0.0555041087F + f * (0.00961812911F + f * 0.00133335581F))));
  return rest * std::bit_cast<float>((static_cast<std::int32_t>(whole) + 127) << 23);
}

/// world::toDisplay() in bytes, with the power 1 / 2.4 as a sum of roots, accurate to 0.3 / 255 (I. Taylor, "sRGB
/// Approximations for HLSL").
HWY_INLINE float displayed(float linear) {
  const float x = std::max(linear, 0.0F) * 0.7F;
  const float mapped = std::min((x * (2.51F * x + 0.14F)) / (x * (2.43F * x + 0.59F) + 0.14F), 1.0F);
  const float root2 = std::sqrt(mapped);
  const float root4 = std::sqrt(root2);
  const float curved =
      0.662002687F * root2 + 0.684122060F * root4 - 0.323583601F * std::sqrt(root4) - 0.0225411470F * mapped;
  return 255.0F * (mapped <= 0.0031308F ? 12.92F * mapped : curved);
}

HWY_INLINE std::uint32_t toByte(float value) {
  constexpr float kHalf = 0.5F;  // lround() would not vectorise
  return static_cast<std::uint32_t>(static_cast<std::int32_t>(value + kHalf));
}

/// By the cosine between a view and the sun.
HWY_INLINE float glowOfHaze(float sunwards) {
  const float power2 = sunwards * sunwards;
  const float power4 = power2 * power2;
  const float power8 = power4 * power4;
  return 0.36F * power4 + 0.30F * power8 * power8;
}

/// Reflectance of water and stone seen along the normal.
constexpr float kReflectance = 0.04F;
/// Of moist stone.
constexpr float kRoughness = 0.5F;

/// The sun's light that a glossy surface mirrors, relative to what a white surface scatters (R. Zioma, "Optimizing PBR
/// for Mobile", SIGGRAPH 2015). Cosines of the normal to the sun and to the eye, and between the sun and the eye.
HWY_INLINE float mirroredSun(float cosine, float towardsEye, float sunToEye) {
  constexpr float kWidth = kRoughness * kRoughness * kRoughness * kRoughness;
  constexpr float kScale = kReflectance * kWidth / (kRoughness + 0.5F);
  // Of the sum of both directions: its square is four times that of the cosine between it and each of them.
  const float squared = 2.0F + 2.0F * sunToEye + 1.0e-3F;
  const float sum = std::max(cosine + towardsEye, 0.0F);
  const float lobe = sum * sum / squared * (kWidth - 1.0F) + 1.0F;
  return kScale / (lobe * lobe * squared);
}

/// The same of light from everywhere.
HWY_INLINE float mirroredSurroundings(float towardsEye) {
  const float grazing = 1.0F - std::min(std::max(towardsEye, 0.0F), 1.0F);
  const float power2 = grazing * grazing;
  return 0.03F + 0.27F * power2 * power2 * grazing;
}

HWY_INLINE void sendToEye(const VertexArrays& v, std::size_t first, std::size_t count, const BoneLight& light,
                          const Indirect& indirect, std::uint32_t* __restrict out) {
  const Vec3 sunColour = light.sunColour;
  const Vec3 haze = light.haze;
  const Vec3 glow = light.hazeGlow;
  const Vec3 tint = light.tintChange;
  const float clearing = light.clearing;
  const float gloss = light.gloss;
  const Vec3 eye = light.eye;
  const Vec3 sun = light.sun;
  const float sunShare = light.sunShare;
  const float* __restrict px = v.positionX.data() + first;
  const float* __restrict py = v.positionY.data() + first;
  const float* __restrict pz = v.positionZ.data() + first;
  const float* __restrict nx = v.normalX.data() + first;
  const float* __restrict ny = v.normalY.data() + first;
  const float* __restrict nz = v.normalZ.data() + first;
  const float* __restrict ar = v.albedoR.data() + first;
  const float* __restrict ag = v.albedoG.data() + first;
  const float* __restrict ab = v.albedoB.data() + first;
  const float* __restrict emission = v.emission.data() + first;
  const float* __restrict tinted = v.tint.data() + first;
  const float* __restrict sunSeen = v.sun.data() + first;
  for (std::size_t i = 0; i < count; ++i) {
    const float cosine = nx[i] * sun.x + ny[i] * sun.y + nz[i] * sun.z;
    const float seen = sunSeen[i] * sunShare;
    const float direct = std::max(0.0F, cosine) * seen;
    const float r = indirect.r[i] + sunColour.r * direct;
    const float g = indirect.g[i] + sunColour.g * direct;
    const float b = indirect.b[i] + sunColour.b * direct;
    const float x = px[i] - eye.x;
    const float y = py[i] - eye.y;
    const float z = pz[i] - eye.z;
    const float length = std::sqrt(x * x + y * y + z * z + 1.0e-8F);
    const float cleared = exponential(clearing * length);
    const float hazy = 1.0F - cleared;
    const float sunwards = (x * sun.x + y * sun.y + z * sun.z) / length;
    const float glowing = glowOfHaze(std::max(0.0F, sunwards));
    const float towardsEye = -(nx[i] * x + ny[i] * y + nz[i] * z) / length;
    const float mirrored = gloss * direct * mirroredSun(cosine, towardsEye, -sunwards);
    const float around = gloss * mirroredSurroundings(towardsEye);
    const float shown = emission[i];
    const auto channel = [&](float albedo, float tintBy, float lit, float reflected, float air, float glowOf) {
      return displayed((albedo * (1.0F + tintBy * tinted[i]) * (lit + shown) + reflected) * cleared +
                       (air + glowOf * glowing) * hazy);
    };
    const auto reflected = [&](float ofSun, float indirectLight) { return ofSun * mirrored + indirectLight * around; };
    const std::uint32_t red = toByte(channel(ar[i], tint.r, r, reflected(sunColour.r, indirect.r[i]), haze.r, glow.r));
    const std::uint32_t green =
        toByte(channel(ag[i], tint.g, g, reflected(sunColour.g, indirect.g[i]), haze.g, glow.g));
    const std::uint32_t blue = toByte(channel(ab[i], tint.b, b, reflected(sunColour.b, indirect.b[i]), haze.b, glow.b));
    const float grazing = std::min(std::max(4.0F * cosine + 0.5F, 0.0F), 1.0F);
    const float relief = seen * grazing * cleared * (sunColour.r + sunColour.g + sunColour.b) / (r + g + b + shown);
    const std::uint32_t alpha = toByte(255.0F / kMaxRelief * std::min(relief, kMaxRelief));
    out[i] = red | green << 8U | blue << 16U | alpha << 24U;
  }
}

void lightRun(const VertexArrays& arrays, std::size_t begin, std::size_t end, const BoneLight& light,
              std::uint32_t* out) {
  Indirect indirect;
  for (std::size_t first = begin; first < end; first += kBlock) {
    const std::size_t count = std::min(kBlock, end - first);
    if (light.baked) {
      copy(arrays, first, count, indirect);
    } else {
      addAmbient(arrays, first, count, light, indirect);
    }
    for (int i = 0; i < light.lampCount; ++i) {
      addLamp(arrays, first, count, light.lampPosition[static_cast<std::size_t>(i)],
              light.lampColour[static_cast<std::size_t>(i)], light.metre, indirect);
    }
    sendToEye(arrays, first, count, light, indirect, out + first);
  }
}

}  // namespace grove::raster::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace grove::raster {

HWY_EXPORT(lightRun);

void lightRun(const VertexArrays& arrays, std::size_t begin, std::size_t end, const BoneLight& light,
              std::uint32_t* out) {
  HWY_DYNAMIC_DISPATCH(lightRun)(arrays, begin, end, light, out);
}

}  // namespace grove::raster

#endif  // HWY_ONCE
