#include "objects/fluid/frontend/smoke_sprites_kernels.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "base/simd/loops.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "objects/fluid/frontend/smoke_sprites_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace grove::objects::fluid::HWY_NAMESPACE {

using world::Vec3;

constexpr float kStretchSeconds = 0.11F;

/// Chris Wellons' low-bias integer hash ("lowbias32").
HWY_INLINE std::uint32_t hash(std::uint32_t seed) {
  seed ^= seed >> 16U;
  seed *= 0x7feb352dU;
  seed ^= seed >> 15U;
  seed *= 0x846ca68bU;
  seed ^= seed >> 16U;
  return seed;
}

/// The lowest 16 bits as a share below 1.
HWY_INLINE float share(std::uint32_t bits) {
  return static_cast<float>(static_cast<int>(bits & 0xFFFFU)) * (1.0F / 65536.0F);
}

/// The index of a particle changes when older ones die; its random lifetime never does, so it seeds the random numbers.
void drawLots(const FluidSnapshot& snapshot, SmokeSprites& sprites) {
  const float* const lifetime = snapshot.lifetime.data();
  float* const rank = sprites.rank.data();
  float* const chanceA = sprites.chanceA.data();
  float* const chanceB = sprites.chanceB.data();
  float* const chanceC = sprites.chanceC.data();
  const std::size_t count = sprites.count;
  GROVE_INDEPENDENT_ITERATIONS
  for (std::size_t i = 0; i < count; ++i) {
    const float steps = lifetime[i] * FluidSnapshot::kLifetimeSteps + 0.5F;
    const std::uint32_t first = hash(static_cast<std::uint32_t>(static_cast<std::int32_t>(steps)));
    const std::uint32_t second = hash(first ^ 0x9e3779b9U);
    rank[i] = share(first);
    chanceA[i] = share(first >> 16U);
    chanceB[i] = share(second);
    chanceC[i] = share(second >> 16U);
  }
}

HWY_INLINE float saturate(float value) { return std::min(1.0F, std::max(0.0F, value)); }

HWY_INLINE float smooth(float low, float high, float value) {
  const float t = saturate((value - low) / (high - low));
  return t * t * (3.0F - 2.0F * t);
}

/// Radius in metres.
HWY_INLINE float sizeOf(float spent, float hot, float chance) {
  const float grown = std::sqrt(saturate(spent));
  const float smoke = (0.09F + 0.36F * grown) * (0.6F + 0.8F * chance);
  const float flame = (0.055F + 0.085F * saturate(4.0F * spent)) * (0.6F + 0.8F * chance);
  return smoke + (flame - smoke) * hot;
}

constexpr float kEmbers = 0.012F;      // share of the particles
constexpr float kEmberSeconds = 1.8F;  // until it is dark
constexpr float kEmberRadius = 0.01F;  // metres
constexpr float kEmberStray = 0.7F;    // metres per second away from the smoke

/// An ember that is dark stays one, because it is no smoke.
HWY_INLINE float emberOf(float age, float chance) {
  const float left = std::max(1e-4F, 1.0F - age / kEmberSeconds);
  return chance < kEmbers ? left : 0.0F;
}

void projectSprites(const FluidSnapshot& snapshot, const SmokeLens& lens, float lead, SmokeSprites& sprites) {
  drawLots(snapshot, sprites);
  // A copy, which the loop's stores cannot change.
  const auto [eye, right, up, forward, focal, middleX, middleY, nearDepth] = lens;
  const float* const px = snapshot.x.data();
  const float* const py = snapshot.y.data();
  const float* const pz = snapshot.z.data();
  const float* const vx = snapshot.velocityX.data();
  const float* const vy = snapshot.velocityY.data();
  const float* const vz = snapshot.velocityZ.data();
  const float* const age = snapshot.age.data();
  const float* const lifetime = snapshot.lifetime.data();
  const float* const temperature = snapshot.temperature.data();
  const float* const chanceA = sprites.chanceA.data();
  const float* const chanceB = sprites.chanceB.data();
  const float* const chanceC = sprites.chanceC.data();
  float* const ember = sprites.ember.data();
  float* const x = sprites.x.data();
  float* const y = sprites.y.data();
  float* const depth = sprites.depth.data();
  float* const radius = sprites.radius.data();
  float* const heat = sprites.heat.data();
  float* const spriteAge = sprites.age.data();
  float* const life = sprites.life.data();
  float* const fade = sprites.fade.data();
  float* const axisX = sprites.axisX.data();
  float* const axisY = sprites.axisY.data();

  const std::size_t count = sprites.count;
  GROVE_INDEPENDENT_ITERATIONS
  for (std::size_t i = 0; i < count; ++i) {
    const float now = age[i] + lead;
    const float bright = emberOf(now, chanceB[i]);
    const float stray = bright > 0.0F ? kEmberStray * now : 0.0F;
    const float dx = px[i] + lead * vx[i] + stray * (chanceA[i] - 0.5F) - eye.x;
    const float dy = py[i] + lead * vy[i] - eye.y;
    const float dz = pz[i] + lead * vz[i] + stray * (chanceC[i] - 0.5F) - eye.z;
    const float along = dx * forward.x + dy * forward.y + dz * forward.z;
    const float inverse = 1.0F / std::max(along, nearDepth);
    const float u = (dx * right.x + dy * right.y + dz * right.z) * inverse;
    const float v = -(dx * up.x + dy * up.y + dz * up.z) * inverse;
    x[i] = middleX + focal * u;
    y[i] = middleY + focal * v;
    depth[i] = along;

    const float spent = now / std::max(lifetime[i], 1e-3F);
    const float hot = smooth(0.28F, 0.58F, temperature[i]);
    const float size = bright > 0.0F ? kEmberRadius : sizeOf(spent, hot, chanceA[i]);
    ember[i] = bright;
    spriteAge[i] = now;
    life[i] = saturate(spent);
    heat[i] = hot;
    radius[i] = size;
    // Sprites close to the eye fade: inside the smoke, visitors see haze instead of huge discs.
    fade[i] = saturate((along - nearDepth - 0.1F) / (0.2F + (bright > 0.0F ? 1.0F : 1.2F * size))) *
              (spent < 1.0F ? 1.0F : 0.0F);

    // Perspective: approaching particles also move outwards on the screen.
    const float speedAlong = vx[i] * forward.x + vy[i] * forward.y + vz[i] * forward.z;
    const float speedX = vx[i] * right.x + vy[i] * right.y + vz[i] * right.z - u * speedAlong;
    const float speedY = -(vx[i] * up.x + vy[i] * up.y + vz[i] * up.z) - v * speedAlong;
    const float wobble = 0.25F * size;
    axisX[i] = kStretchSeconds * speedX + wobble * (chanceA[i] - 0.5F);
    axisY[i] = kStretchSeconds * speedY + wobble * (chanceB[i] - 0.5F);
  }
}

void shapeSprites(const SmokeLens& lens, float minPixels, SmokeSprites& sprites) {
  const float focal = lens.focal;
  const float nearDepth = lens.nearDepth;
  const float* const depth = sprites.depth.data();
  const float* const radius = sprites.radius.data();
  const float* const heat = sprites.heat.data();
  const float* const axisX = sprites.axisX.data();
  const float* const axisY = sprites.axisY.data();
  float* const xx = sprites.xx.data();
  float* const xy = sprites.xy.data();
  float* const yy = sprites.yy.data();
  float* const halfWidth = sprites.halfWidth.data();
  float* const halfHeight = sprites.halfHeight.data();
  float* const shrink = sprites.shrink.data();

  const std::size_t count = sprites.count;
  GROVE_INDEPENDENT_ITERATIONS
  for (std::size_t i = 0; i < count; ++i) {
    const float length = std::sqrt(axisX[i] * axisX[i] + axisY[i] * axisY[i]) + 1e-6F;
    const float c = axisX[i] / length;
    const float s = axisY[i] / length;
    const float ratio = std::min(length / radius[i], 2.5F);
    const float pixels = focal * radius[i] / std::max(depth[i], nearDepth);
    const float trueMajor = pixels * (1.0F + (0.55F + 0.25F * heat[i]) * ratio);
    const float trueMinor = pixels / (1.0F + 0.3F * ratio);
    const float major = std::max(trueMajor, minPixels);
    const float minor = std::max(trueMinor, minPixels);
    shrink[i] = (trueMajor * trueMinor) / (major * minor);
    const float a = 1.0F / (major * major);
    const float b = 1.0F / (minor * minor);
    xx[i] = c * c * a + s * s * b;
    xy[i] = c * s * (a - b);
    yy[i] = s * s * a + c * c * b;
    halfWidth[i] = std::sqrt(c * c * major * major + s * s * minor * minor);
    halfHeight[i] = std::sqrt(s * s * major * major + c * c * minor * minor);
  }
}

SpriteBlocks estimateBlocks(const SmokeSprites& sprites, float width, float height, float scale) {
  const float* const x = sprites.x.data();
  const float* const y = sprites.y.data();
  const float* const halfWidth = sprites.halfWidth.data();
  const float* const halfHeight = sprites.halfHeight.data();
  const float* const heat = sprites.heat.data();
  const float* const fade = sprites.fade.data();
  float smoke = 0.0F;
  float flame = 0.0F;
  float left = width;
  float top = height;
  float right = 0.0F;
  float bottom = 0.0F;
  const std::size_t count = sprites.count;
  GROVE_INDEPENDENT_ITERATIONS
  for (std::size_t i = 0; i < count; ++i) {
    const float columns = std::min(x[i] + halfWidth[i], width) - std::max(x[i] - halfWidth[i], 0.0F);
    const float rows = std::min(y[i] + halfHeight[i], height) - std::max(y[i] - halfHeight[i], 0.0F);
    const bool seen = columns > 0.0F && rows > 0.0F && fade[i] > 0.0F;
    const float blocks = seen ? (rows / scale) * (0.7F * columns / (16.0F * scale) + 0.8F) : 0.0F;
    // Not std::min: GCC does not vectorise its references as a reduction.
    const float thisLeft = seen ? x[i] - halfWidth[i] : width;
    const float thisTop = seen ? y[i] - halfHeight[i] : height;
    const float thisRight = seen ? x[i] + halfWidth[i] : 0.0F;
    const float thisBottom = seen ? y[i] + halfHeight[i] : 0.0F;
    left = thisLeft < left ? thisLeft : left;
    top = thisTop < top ? thisTop : top;
    right = thisRight > right ? thisRight : right;
    bottom = thisBottom > bottom ? thisBottom : bottom;
    flame += heat[i] * blocks;
    smoke += (1.0F - heat[i]) * blocks;
  }
  return {smoke, flame, {left, top, right, bottom}};
}

SpriteBounds markSeen(float width, float height, float nearDepth, float farDepth, SmokeSprites& sprites) {
  const float* const x = sprites.x.data();
  const float* const y = sprites.y.data();
  const float* const depth = sprites.depth.data();
  const float* const opacity = sprites.opacity.data();
  const float* const halfWidth = sprites.halfWidth.data();
  const float* const halfHeight = sprites.halfHeight.data();
  std::uint32_t* const seen = sprites.seen.data();
  float left = width;
  float top = height;
  float right = 0.0F;
  float bottom = 0.0F;
  const std::size_t count = sprites.count;
  GROVE_INDEPENDENT_ITERATIONS
  for (std::size_t i = 0; i < count; ++i) {
    const float thisLeft = x[i] - halfWidth[i];
    const float thisTop = y[i] - halfHeight[i];
    const float thisRight = x[i] + halfWidth[i];
    const float thisBottom = y[i] + halfHeight[i];
    const bool shows = (depth[i] >= nearDepth) & (depth[i] <= farDepth) & (opacity[i] >= kMinOpacity) &
                       (thisRight > 0.0F) & (thisBottom > 0.0F) & (thisLeft < width) & (thisTop < height);
    // Not std::min, see estimateBlocks().
    const float leftHere = shows ? thisLeft : width;
    const float topHere = shows ? thisTop : height;
    const float rightHere = shows ? thisRight : 0.0F;
    const float bottomHere = shows ? thisBottom : 0.0F;
    left = leftHere < left ? leftHere : left;
    top = topHere < top ? topHere : top;
    right = rightHere > right ? rightHere : right;
    bottom = bottomHere > bottom ? bottomHere : bottom;
    seen[i] = shows ? 1U : 0U;
  }
  return {left, top, right, bottom};
}

}  // namespace grove::objects::fluid::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace grove::objects::fluid {

HWY_EXPORT(projectSprites);
HWY_EXPORT(shapeSprites);
HWY_EXPORT(estimateBlocks);
HWY_EXPORT(markSeen);

void projectSprites(const FluidSnapshot& snapshot, const SmokeLens& lens, float lead, SmokeSprites& sprites) {
  HWY_DYNAMIC_DISPATCH(projectSprites)(snapshot, lens, lead, sprites);
}

void shapeSprites(const SmokeLens& lens, float minPixels, SmokeSprites& sprites) {
  HWY_DYNAMIC_DISPATCH(shapeSprites)(lens, minPixels, sprites);
}

SpriteBlocks estimateBlocks(const SmokeSprites& sprites, float width, float height, float scale) {
  return HWY_DYNAMIC_DISPATCH(estimateBlocks)(sprites, width, height, scale);
}

SpriteBounds markSeen(float width, float height, float nearDepth, float farDepth, SmokeSprites& sprites) {
  return HWY_DYNAMIC_DISPATCH(markSeen)(width, height, nearDepth, farDepth, sprites);
}

}  // namespace grove::objects::fluid

#endif  // HWY_ONCE
