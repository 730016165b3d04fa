#include "objects/ground/frontend/grow_kernels.h"

#include <algorithm>
#include <array>
#include <bit>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "objects/ground/frontend/grow_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "base/simd/lanes_inl.h"
#include "objects/ground/frontend/halves_inl.h"

HWY_BEFORE_NAMESPACE();
namespace grove::objects::ground::HWY_NAMESPACE {
namespace {

namespace lanes = grove::simd::HWY_NAMESPACE;
using lanes::Floats;
using lanes::Ints;
using lanes::kLanes;
using lanes::Mask;

/// The meadow is rotated against the axes, so that its tiles do not line up with the path.
constexpr float kTurnCosine = 0.81915F;
constexpr float kTurnSine = 0.57358F;

/// Period of the pattern of two levels, in pixels.
constexpr int kPattern = 16;

/// Two adjacent levels of a repeating pyramid. Pixels choose between the two in a fixed pattern, the coarser one in
/// proportion to `sampling.coarser`, so that no line shows where the level changes. Coordinates are in 2^-32 of the
/// tile and wrap around by overflow.
struct TiledLevels {
  int bits;                                               // the finer level has 2^bits texels per side
  alignas(64) std::array<std::int32_t, kPattern> coarse;  // 1 where the coarser level is sampled
  alignas(64) std::array<std::int32_t, kPattern> begins;  // offset of each pixel's level

  /// `turn` is any number that differs between adjacent rows and taps.
  HWY_INLINE TiledLevels(const Pyramid& pyramid, const MeadowSampling& sampling, int turn)
      : bits(std::countr_zero(static_cast<unsigned>(pyramid.size())) - sampling.level) {
    const auto next = static_cast<std::int32_t>(pyramid.level(sampling.level + 1) - pyramid.level(sampling.level));
    for (int i = 0; i < kPattern; i += kLanes) {
      const Ints order = ((lanes::upwards() + Ints(i + turn)) * Ints(7)) & Ints(kPattern - 1);
      const Mask coarser = lanes::toFloats(order) + 0.5F < lanes::Floats(sampling.coarser * kPattern);
      lanes::store(lanes::onlyWhere(coarser, Ints(1)), coarse.data() + i);
      lanes::store(lanes::onlyWhere(coarser, Ints(next)), begins.data() + i);
    }
  }

  /// Texel indices of one vector of pixels, `i` pixels into the pattern. See Pyramid::inBlocks().
  HWY_INLINE Ints index(Ints x, Ints y, int i) const {
    static_assert(Pyramid::kBlock == 4);
    const Mask coarser = lanes::load(coarse.data() + i) > Ints(0);
    const auto atLevel = [&](Ints fine) { return lanes::select(coarser, lanes::shiftRight<1>(fine), fine); };
    const hn::RebindToUnsigned<lanes::IntTag> bitsTag;
    const auto texelsOf = [&](Ints turns) -> Ints {
      return hn::BitCast(lanes::IntTag(), hn::ShiftRightSame(hn::BitCast(bitsTag, turns.raw), 32 - bits));
    };
    const Ints column = atLevel(texelsOf(x));
    const Ints line = atLevel(texelsOf(y));
    const Ints blockLine = atLevel(Ints(hn::ShiftLeftSame((line & Ints(~3)).raw, bits)));
    const Ints inBlock = lanes::shiftLeft<2>((column & Ints(~3)) + (line & Ints(3))) + (column & Ints(3));
    return lanes::load(begins.data() + i) + blockLine + inBlock;
  }
};

/// Places in the meadow of a row's pixels, in 2^-32 of the tile.
struct MeadowPlaces {
  alignas(64) std::array<std::int32_t, kTile> x;
  alignas(64) std::array<std::int32_t, kTile> y;
};

/// A fraction of the tile, which repeats, in 2^-32.
HWY_INLINE Ints wrapped(Floats tiles) {
  const Floats fraction = tiles - lanes::floor(tiles);
  return lanes::truncate((fraction - 0.5F) * 4294967296.0F) + Ints(std::numeric_limits<std::int32_t>::min());
}

/// Interpolates between the samples.
HWY_INLINE void spreadPlaces(const std::array<std::int32_t, kCoarsePadded>& samples,
                             std::array<std::int32_t, kTile>& out) {
  const hn::CappedTag<std::int32_t, kCoarse> tag;
  constexpr std::size_t kColumns = hn::MaxLanes(tag);
  for (std::size_t i = 0; i < kTile / kCoarse; ++i) {
    const auto first = hn::Set(tag, samples[i]);
    const auto step = hn::ShiftRight<3>(hn::Sub(hn::Set(tag, samples[i + 1]), first));
    static_assert(kCoarse == 1 << 3);
    for (std::size_t from = 0; from < kCoarse; from += kColumns) {
      const auto columns = hn::Iota(tag, static_cast<std::int32_t>(from));
      hn::Store(hn::Add(first, hn::Mul(columns, step)), tag, out.data() + i * kCoarse + from);
    }
  }
}

/// `share`: how far towards the next nearer row.
HWY_INLINE void placeRow(const Frame& frame, const GroundRow& ground, float share, float metres, MeadowPlaces& out) {
  alignas(64) std::array<std::int32_t, kCoarsePadded> x;
  alignas(64) std::array<std::int32_t, kCoarsePadded> y;
  const float perMetre = 1.0F / metres;
  for (std::size_t i = 0; i < kCoarsePadded; i += kLanes) {
    const Floats nearer = lanes::load(ground.step.data() + i) / lanes::load(ground.depth.data() + i) * share;
    const Floats worldX = lanes::load(ground.x.data() + i);
    const Floats worldZ = lanes::load(ground.z.data() + i);
    const Floats atX = (worldX - (worldX - frame.eyeX) * nearer) * perMetre;
    const Floats atZ = (worldZ - (worldZ - frame.eyeZ) * nearer) * perMetre;
    lanes::store(wrapped(atX * kTurnCosine - atZ * kTurnSine), x.data() + i);
    lanes::store(wrapped(atX * kTurnSine + atZ * kTurnCosine), y.data() + i);
  }
  spreadPlaces(x, out.x);
  spreadPlaces(y, out.y);
}

/// Computes each pixel's texel index.
HWY_INLINE void findTexels(const TiledLevels& levels, const MeadowPlaces& places, std::int32_t* HWY_RESTRICT at) {
  for (int first = 0; first < kTile; first += kPattern) {
    for (int i = 0; i < kPattern; i += kLanes) {
      const Ints x = lanes::load(places.x.data() + first + i);
      const Ints y = lanes::load(places.y.data() + first + i);
      lanes::store(levels.index(x, y, i), at + first + i);
    }
  }
}

using TexelRow = std::array<std::uint32_t, kTile>;

/// A row's samples, tap by tap.
struct Taps {
  const Frame& frame;
  const GroundRow& ground;
  const Meadow& meadow;
  const MeadowSampling& sampling;

  HWY_INLINE void sample(int tap, std::uint32_t* HWY_RESTRICT out) const {
    // Along the pixel's ray; the first tap is the farthest.
    const float share = (static_cast<float>(tap) + 0.5F) / static_cast<float>(sampling.taps) - 0.5F;
    MeadowPlaces places;
    placeRow(frame, ground, share, meadow.metres, places);
    alignas(64) std::array<std::int32_t, kTile> at;
    findTexels(TiledLevels(meadow.pyramid, sampling, ground.row * 5 + tap * 9), places, at.data());
    lookUp<kTile>(meadow.pyramid.level(sampling.level), at.data(), out);
  }
};

/// Averages the colours. Keeps the heights of `into`; averaged heights would shrink distant tufts.
HWY_INLINE void average(std::uint32_t* HWY_RESTRICT into, const std::uint32_t* HWY_RESTRICT other) {
  const PixelTag tag;
  const Pixels height = hn::Set(tag, 0xFF000000U);
  const Pixels low = hn::Set(tag, 0x7F7F7F7FU);
  for (std::size_t i = 0; i < kTile; i += kPixels) {
    const Pixels a = hn::Load(tag, into + i);
    const Pixels b = hn::Load(tag, other + i);
    const Pixels mean = hn::Add(hn::And(a, b), hn::And(hn::ShiftRight<1>(hn::Xor(a, b)), low));
    hn::Store(hn::Or(hn::AndNot(height, mean), hn::And(height, a)), tag, into + i);
  }
}

void sampleMeadow(const Taps& taps, std::uint32_t* HWY_RESTRICT texels) {
  taps.sample(0, texels);
  if (taps.sampling.taps == 1) return;
  alignas(64) TexelRow second;
  taps.sample(1, second.data());
  average(texels, second.data());
  if (taps.sampling.taps == 2) return;
  alignas(64) TexelRow third;
  taps.sample(2, second.data());
  taps.sample(3, third.data());
  average(second.data(), third.data());
  average(texels, second.data());
}

/// Heights in pixels of the tallest grass, in steps of 1/256. Limited: the search would not find taller grass.
using Heights = std::array<std::uint16_t, kTile>;

HWY_INLINE void measureTallest(const Frame& frame, const GroundRow& ground, Heights& out) {
  const float scale = std::max(0.0F, frame.focal * ground.ahead) * kTallest;
  for (std::size_t i = 0; i < kTile / kCoarse; ++i) {
    const float pixels = std::min(scale / ground.depth[i], 254.0F) * (65536.0F / 255.0F);
    std::fill_n(out.begin() + static_cast<std::ptrdiff_t>(i * kCoarse), kCoarse, static_cast<std::uint16_t>(pixels));
  }
}

/// Computes the screen row that each pixel's grass reaches; returns the highest.
std::int16_t reachUp(int row, const Heights& tallest, const SoilBetween& soil, const std::uint32_t* HWY_RESTRICT texels,
                     std::int16_t* HWY_RESTRICT tops) {
  const HalfTag tag;
  const UnsignedHalfTag unsignedTag;
  const PixelTag pixelTag;
  const Halves base = halves(row);
  Halves highest = base;
  for (std::size_t i = 0; i < kTile; i += kHalves) {
    const UnsignedHalves left = hn::BitCast(unsignedTag, hn::Load(pixelTag, texels + i));
    const UnsignedHalves right = hn::BitCast(unsignedTag, hn::Load(pixelTag, texels + i + kPixels));
    const UnsignedHalves blade = hn::And(hn::ConcatOdd(unsignedTag, right, left), unsignedHalves(0xFF00));
    const UnsignedHalves tall =
        hn::MulHigh(hn::BitCast(unsignedTag, grassAt(soil, i)), hn::Load(unsignedTag, tallest.data() + i));
    const UnsignedHalves rise = hn::ShiftRight<7>(hn::Add(hn::MulHigh(blade, tall), unsignedHalves(64)));
    const Halves top = hn::Sub(base, hn::BitCast(tag, rise));
    hn::Store(top, tag, tops + i);
    highest = hn::Min(highest, top);
  }
  return hn::GetLane(hn::MinOfLanes(tag, highest));
}

void growGrass(const Frame& frame, const GroundRow& ground, const Meadow& meadow, const MeadowSampling& sampling,
               const SoilBetween& soil, GrassRows& grass) {
  const auto slot = static_cast<std::size_t>(ground.row & (kRootRows - 1));
  std::uint32_t* const texels = grass.texels.data() + slot * kTile;
  sampleMeadow({frame, ground, meadow, sampling}, texels);
  alignas(64) Heights tallest;
  measureTallest(frame, ground, tallest);
  grass.highest[slot] = reachUp(ground.row, tallest, soil, texels, grass.tops.data() + slot * kTile);
  auto* const inverse = grass.inverseDepths.data() + slot * kCoarsePadded;
  for (std::size_t i = 0; i < kCoarsePadded; i += kLanes) {
    lanes::store(Floats(1.0F) / lanes::load(ground.depth.data() + i), inverse + i);
  }
}

}  // namespace
}  // namespace grove::objects::ground::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace grove::objects::ground {

HWY_EXPORT(growGrass);

void growGrass(const Frame& frame, const GroundRow& ground, const Meadow& meadow, const MeadowSampling& sampling,
               const SoilBetween& soil, GrassRows& grass) {
  HWY_DYNAMIC_DISPATCH(growGrass)(frame, ground, meadow, sampling, soil, grass);
}

}  // namespace grove::objects::ground

#endif  // HWY_ONCE
