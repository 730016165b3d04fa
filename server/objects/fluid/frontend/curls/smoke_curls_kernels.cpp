#include "objects/fluid/frontend/curls/smoke_curls_kernels.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "objects/fluid/frontend/curls/smoke_curls_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "base/simd/lanes_inl.h"

HWY_BEFORE_NAMESPACE();
namespace grove::objects::fluid::HWY_NAMESPACE {

using namespace simd::HWY_NAMESPACE;

HWY_INLINE Floats limited(Floats value) { return clamp(value, Floats(0.0F), Floats(1.0F)); }

/// Approximations of sine and cosine of period 1.
struct Swing {
  Floats sine, cosine;

  HWY_INLINE explicit Swing(Floats turns) {
    const Floats off = turns - floor(turns + Floats(0.5F));
    const Floats away = abs(off);
    const Floats past = Floats(0.25F) - away;
    sine = Floats(16.0F) * off * (Floats(0.5F) - away);
    cosine = Floats(16.0F) * past * (Floats(0.5F) - abs(past));
  }
};

struct Point {
  Floats x, y, z;
};

/// Weights 0..1 of the octaves.
struct Octaves {
  Floats weight[kCurlOctaves];

  /// `finest`: width in metres of the finest visible detail.
  HWY_INLINE explicit Octaves(Floats finest) {
    const Floats sharpness = Floats(0.13F) / finest;
    for (int o = 0; o < kCurlOctaves; ++o) {
      weight[o] = limited(mulAdd(sharpness, Floats(1.0F / kCurlPeriods[o]), Floats(-0.6F)));
    }
  }
};

/// Noise of about -1 to 1, 0 on average, with round hills and narrow valleys: the absolute value of a gyroid, whose
/// axes each octave permutes and bends for the next one.
template <int Count>
HWY_INLINE Floats billows(Point at, const Octaves& octaves) {
  Floats sum(0.0F);
  float share = 0.5F;
  for (int o = 0; o < Count; ++o) {
    if (!any(octaves.weight[o] > Floats(0.0F))) break;
    const Floats k(kCurlPeriods[o]);
    const Swing a(k * at.x);
    const Swing b(k * at.y);
    const Swing c(k * at.z);
    const Floats u = a.sine * c.cosine;
    const Floats v = b.sine * a.cosine;
    const Floats w = c.sine * b.cosine;
    const Floats gyroid = u + v + w;
    const Floats hill = sqrt(mulAdd(gyroid, gyroid, Floats(0.2F))) - Floats(0.96F);
    sum = mulAdd(Floats(share) * octaves.weight[o], hill, sum);
    const Floats bend(0.1F / kCurlPeriods[o]);
    at = {mulAdd(bend, u - v, at.z), mulAdd(bend, v - w, at.x) + Floats(0.37F), mulAdd(bend, w - u, at.y)};
    share *= 0.55F;
  }
  return sum;
}

/// Carves kLanes pixels.
struct Carver {
  const CurlLens& lens;

  /// Means of the smoke in kLanes pixels.
  struct Smoke {
    Floats clear, cover, perCover, age;

    HWY_INLINE Smoke(const SmokeBlock& block, int lane)
        : clear(load(block.clear + lane)),
          cover(Floats(1.0F) - clear),
          perCover(Floats(1.0F) / max(cover, Floats(1e-4F))),
          age(load(block.age + lane) * perCover) {}
  };

  /// The change of the age between neighbouring pixels: to the row below and within pairs of columns.
  HWY_INLINE static Floats slope(Floats age, Floats below) {
    return max(abs(below - age), abs(Floats(hn::Shuffle2301(age.raw)) - age));
  }

  /// The point of the noise at `distance` along the rays through row `y`.
  HWY_INLINE Point pointAt(Floats column, float y, Floats distance, Floats age) const {
    const auto along = [&](float eye, float corner, float right, float down) {
      return mulAdd(distance, mulAdd(column, Floats(right), Floats(corner + y * down)), Floats(eye));
    };
    const Floats height = along(lens.eye.y, lens.corner.y, lens.right.y, lens.down.y);
    const Floats carried = mulAdd(Floats(kCurlPace * kCurlDrag), age, Floats(-lens.risen));
    return {along(lens.eye.x, lens.corner.x, lens.right.x, lens.down.x),
            mulAdd(Floats(1.0F - kCurlDrag), height, carried),
            along(lens.eye.z, lens.corner.z, lens.right.z, lens.down.z)};
  }

  HWY_INLINE Floats towardsSun(Point at, const Octaves& octaves) const {
    constexpr float kStep = 0.1F;  // metres
    return billows<2>(
        {at.x + Floats(kStep * lens.sun.x), at.y + Floats(kStep * lens.sun.y), at.z + Floats(kStep * lens.sun.z)},
        octaves);
  }

  HWY_INLINE void operator()(const SmokeBlock& below, int lane, Floats column, float y, SmokeBlock& block) const {
    const Floats one(1.0F);
    const Floats zero(0.0F);
    const Smoke smoke(block, lane);
    if (!any(smoke.cover > Floats(1.0F / 512.0F))) return;
    const Floats age = smoke.age;
    const Floats distance = max(Floats(0.1F), load(block.distance + lane) * smoke.perCover);
    const Floats steep = Floats(kCurlPace * kCurlDrag) * slope(age, Smoke(below, lane).age);
    const Octaves octaves(max(steep, distance * Floats(lens.finest)));
    const Point at = pointAt(column, y, distance, age);
    const Floats hill = billows<kCurlOctaves>(at, octaves);

    // Flames have a noise of their own, long and narrow. Other smoke needs the one below it.
    const Mask flaming = age < Floats(kFlameSeconds);
    const Floats flame = limited((Floats(kFlameSeconds) - age) * Floats(2.0F));
    const Floats grown = limited((age - Floats(kFlameSeconds)) * Floats(2.0F));
    const Floats narrow = select(flaming, Floats(1.6F), one);
    const Point aside{narrow * at.x, select(flaming, Floats(0.5F) * at.y, at.y - Floats(0.08F)), narrow * at.z};
    const Floats other = billows<3>(aside, octaves);
    const Floats tongue = mulAdd(Floats(2.4F), other, octaves.weight[0] * mulAdd(Floats(-0.5F), age, Floats(0.15F)));
    const Floats lick = clamp(mulAdd(flame, tongue, one), zero, Floats(1.3F));

    // The noise multiplies the odds cover / (1 - cover), so cover stays within 0 and 1. Old smoke has less contrast.
    const Floats crisp = clamp(mulAdd(Floats(-0.2F), age, Floats(1.25F)), Floats(0.3F), one);
    const Floats root = max(zero, mulAdd(Floats(0.45F) * crisp, hill, one));
    const Floats square = root * root;
    const Floats odds = square * square;
    const Floats cover = odds * smoke.cover / mulAdd(odds, smoke.cover, smoke.clear) * min(lick, one);

    // Hills are lighter than valleys, and those that fall towards the sun than those that rise.
    const Floats relief = mulAdd(Floats(0.35F), hill - towardsSun(at, octaves), Floats(0.2F) * hill);
    const Floats light = clamp(mulAdd((one - flame) * crisp, relief, one), Floats(0.8F), Floats(1.15F));
    const Floats gain = cover * smoke.perCover * light;
    // The flames light those that fall towards them.
    const Floats rise = age * age * Floats(1.44F);
    const Floats warm = cover * grown * limited(Floats(0.2F) * (hill - other)) / mulAdd(rise, rise, Floats(0.5F));
    store(mulAdd(warm, Floats(2.6F), load(block.red + lane) * gain * max(lick, one)), block.red + lane);
    store(mulAdd(warm, Floats(1.05F), load(block.green + lane) * gain * lick), block.green + lane);
    store(mulAdd(warm, Floats(0.3F), load(block.blue + lane) * gain * lick), block.blue + lane);
    store(one - cover, block.clear + lane);
  }
};

void carveCurls(const CurlLens& lens, const SmokePixels& pixels) {
  const Carver carve{lens};
  for (int b = 0; b < pixels.blocksPerRow; ++b) {
    const SmokeSpan& span = pixels.spans[b];
    SmokeBlock* const column = pixels.column(b);
    for (int lane = 0; lane < SmokeBlock::kWidth; lane += kLanes) {
      const Floats x = toFloats(upwards()) + Floats(static_cast<float>(b * SmokeBlock::kWidth + lane));
      for (int y = span.begin; y < span.end; ++y) {
        carve(column[std::min(y + 1, span.end - 1)], lane, x, static_cast<float>(y), column[y]);
      }
    }
  }
}

}  // namespace grove::objects::fluid::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace grove::objects::fluid {

HWY_EXPORT(carveCurls);

void carveCurls(const CurlLens& lens, const SmokePixels& pixels) { HWY_DYNAMIC_DISPATCH(carveCurls)(lens, pixels); }

}  // namespace grove::objects::fluid

#endif  // HWY_ONCE
