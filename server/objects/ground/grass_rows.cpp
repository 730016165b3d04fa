#include "objects/ground/grass_rows.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "objects/ground/halves.h"

namespace grove::objects::ground {
namespace {

/// The meadow lies turned against the axes, so that its tiles do not line up with the path.
constexpr double kTurnCosine = 0.81915;
constexpr double kTurnSine = 0.57358;

/// Far grass is sampled by so many levels coarser than what a pixel covers, or it would sparkle when the eye moves.
constexpr float kSoftness = 0.5F;

/// Two neighbouring levels of a pyramid that repeats. Pixels alternate between the two in a fixed pattern, the more of
/// them coarser the larger the sampling's share is, so that no line shows where the level changes. Coordinates are
/// fractions of the tile of 2^-32, which wrap around by themselves.
struct TiledLevels {
  const std::uint32_t* __restrict texels;
  // One for each lane: where its level begins, and what makes columns, lines and rows of blocks of coordinates.
  alignas(64) std::array<unsigned, kLanes> offset;
  alignas(64) std::array<unsigned, kLanes> shift;
  alignas(64) std::array<unsigned, kLanes> blockShift;
  alignas(64) std::array<unsigned, kLanes> blockMask;

  /// `turn` is any number that differs between neighbouring rows and taps.
  TiledLevels(const Pyramid& pyramid, const MeadowSampling& sampling, int turn)
      : texels(pyramid.level(sampling.level)) {
    const auto coarseOffset = static_cast<unsigned>(pyramid.level(sampling.level + 1) - texels);
    const auto bits = static_cast<unsigned>(std::countr_zero(static_cast<unsigned>(pyramid.size())) - sampling.level);
    for (int lane = 0; lane < kLanes; ++lane) {
      const auto at = static_cast<std::size_t>(lane);
      const bool coarse = static_cast<float>(((turn + lane) * 7) & 15) + 0.5F < sampling.coarser * 16.0F;
      const unsigned own = coarse ? bits - 1 : bits;
      offset[at] = coarse ? coarseOffset : 0;
      shift[at] = 32U - own;
      blockShift[at] = 32U - 2U * own;
      blockMask[at] = ((1U << own) - Pyramid::kBlock) << own;
    }
  }

  /// See Pyramid::inBlocks().
  [[nodiscard]] int index(std::uint32_t x, std::uint32_t y, unsigned lane) const {
    static_assert(Pyramid::kBlock == 4);
    const std::uint32_t column = x >> shift[lane];
    const std::uint32_t line = y >> shift[lane];
    const std::uint32_t block = ((y >> blockShift[lane]) & blockMask[lane]) + ((column & ~3U) << 2U);
    return static_cast<int>(offset[lane] + block + ((line & 3U) << 2U) + (column & 3U));
  }
};

/// Where a row's pixels lie in the meadow: at the tile's first column, and per column.
struct TexelLine {
  std::uint32_t x, y, stepX, stepY;

  TexelLine(const Frame& frame, double depth, double ahead, int firstColumn, double metres) {
    const double side = static_cast<double>(frame.firstSide) + firstColumn * static_cast<double>(frame.sideStep);
    const double worldX = frame.eyeX + depth * (ahead * frame.forwardX + side * frame.sideX);
    const double worldZ = frame.eyeZ + depth * (ahead * frame.forwardZ + side * frame.sideZ);
    const double worldStepX = depth * frame.sideStep * frame.sideX;
    const double worldStepZ = depth * frame.sideStep * frame.sideZ;
    const auto wrapped = [&](double distance) {
      return static_cast<std::uint32_t>(static_cast<std::int64_t>(distance / metres * 4294967296.0));
    };
    x = wrapped(worldX * kTurnCosine - worldZ * kTurnSine);
    y = wrapped(worldX * kTurnSine + worldZ * kTurnCosine);
    stepX = wrapped(worldStepX * kTurnCosine - worldStepZ * kTurnSine);
    stepY = wrapped(worldStepX * kTurnSine + worldStepZ * kTurnCosine);
  }
};

void sampleLine(const TiledLevels& levels, TexelLine line, std::uint32_t* __restrict out) {
  const std::uint32_t* __restrict texels = levels.texels;
  for (int first = 0; first < kTile; first += kLanes) {
    for (unsigned lane = 0; lane < kLanes; ++lane) {
      const std::uint32_t x = line.x + lane * line.stepX;
      const std::uint32_t y = line.y + lane * line.stepY;
      out[first + static_cast<int>(lane)] = texels[levels.index(x, y, lane)];
    }
    line.x += kLanes * line.stepX;
    line.y += kLanes * line.stepY;
  }
}

/// Of one of the samples along a pixel's ray; the first is the farthest.
double depthOfTap(const Frame& frame, const Row& row, const MeadowSampling& sampling, int tap) {
  const float share = (static_cast<float>(tap) + 0.5F) / static_cast<float>(sampling.taps) - 0.5F;
  return static_cast<double>(row.depth) - static_cast<double>(share * row.depth * row.depth * frame.inverseStep);
}

int turnOf(const Row& row, int tap) { return row.row * 5 + tap * 9; }

/// Means of the colours; heights stay those of `into`, or tufts would shrink where they are far.
void average(std::uint32_t* __restrict into, const std::uint32_t* __restrict other) {
  constexpr std::uint32_t kHeight = 0xFF000000U;
  for (int i = 0; i < kTile; ++i) {
    const std::uint32_t mean = (into[i] & other[i]) + (((into[i] ^ other[i]) >> 1U) & 0x7F7F7F7FU);
    into[i] = (mean & ~kHeight) | (into[i] & kHeight);
  }
}

/// Of a vector of columns.
Halves grassAt(const SoilBetween& soil, int first) {
  return load<Halves>(soil.first.grass.data() + first) +
         load<Halves>(soil.step.grass.data() + first) * static_cast<std::int16_t>(soil.steps);
}

}  // namespace

MeadowSampling samplingFor(const Row& row, const Meadow& meadow) {
  const float texel = meadow.metres / static_cast<float>(meadow.pyramid.size());
  MeadowSampling sampling;
  sampling.taps = row.along < 2.0F * texel ? 1 : row.along < 8.0F * row.across ? 2 : 4;
  const float even = std::sqrt(row.across * row.along);
  const float size = std::max(row.across, std::min(even, row.along / static_cast<float>(sampling.taps)));
  const float exact = std::max(0.0F, std::log2(size / texel));
  const auto coarsest = static_cast<float>(meadow.pyramid.levels() - 5);
  const float lod = std::clamp(exact + std::min(exact, kSoftness), 0.0F, coarsest);
  sampling.level = static_cast<int>(lod);
  sampling.coarser = lod - std::floor(lod);
  return sampling;
}

void growGrass(const Frame& frame, const Row& row, int firstColumn, const Meadow& meadow,
               const MeadowSampling& sampling, const SoilBetween& soil, GrassRows& grass) {
  const auto slot = static_cast<std::size_t>(row.row & (kRootRows - 1));
  std::uint32_t* __restrict texels = grass.texels.data() + slot * kTile;
  const auto tap = [&](int index, std::uint32_t* out) {
    sampleLine(TiledLevels(meadow.pyramid, sampling, turnOf(row, index)),
               TexelLine(frame, depthOfTap(frame, row, sampling, index), row.ahead, firstColumn, meadow.metres), out);
  };
  tap(0, texels);
  if (sampling.taps > 1) {
    alignas(64) std::array<std::uint32_t, kTile> second;
    tap(1, second.data());
    average(texels, second.data());
    if (sampling.taps > 2) {
      alignas(64) std::array<std::uint32_t, kTile> third;
      tap(2, second.data());
      tap(3, third.data());
      average(second.data(), third.data());
      average(texels, second.data());
    }
  }

  // Pixels that the tallest grass rises above its root, in steps of 1/256; higher ones would not be searched anyway.
  const auto tallest =
      static_cast<std::uint16_t>(std::min(row.pixelsPerMetre * kTallest, 254.0F) * (65536.0F / 255.0F));
  std::int16_t* __restrict tops = grass.tops.data() + slot * kTile;
  alignas(64) std::array<std::uint16_t, kTile> blades;
  for (std::size_t i = 0; i < kTile; ++i) blades[i] = static_cast<std::uint16_t>((texels[i] >> 24U) << 8U);
  const auto base = static_cast<std::int16_t>(row.row);
  Halves highest = Halves{} + base;
  for (int i = 0; i < kTile; i += kHalves) {
    const auto height = reinterpret_cast<UnsignedHalves>(grassAt(soil, i));
    const UnsignedHalves tall = upper(height, UnsignedHalves{} + tallest);
    const UnsignedHalves rise = (upper(load<UnsignedHalves>(blades.data() + i), tall) + 64) >> 7;
    const Halves top = base - reinterpret_cast<Halves>(rise);
    store(top, tops + i);
    highest = least(highest, top);
  }
  std::int16_t least = base;
  for (int i = 0; i < kHalves; ++i) least = std::min<std::int16_t>(least, highest[i]);
  grass.highest[slot] = least;
}

namespace {

/// How much of the root of albedo shows of blades that stand this many rows nearer than where they are seen.
struct Shares {
  alignas(64) std::array<Root, kRootRows> roots;
  float first = 0.0F;  ///< of what stands in the row itself
  float tops = 0.0F;   ///< where blades are shorter than a pixel only their tops are seen

  Shares(const Row& row, int reach) {
    tops = std::clamp(1.5F - 0.5F * row.pixelsPerMetre * (0.35F * kTallest), 0.0F, 1.0F);
    const float heightStep = 1.0F / (std::max(1e-3F, row.pixelsPerMetre) * (0.62F * kTallest));
    const auto reliefAt = [&](int above) {
      // Deep in the grass it is dark; the curve is the root of 0.30 + 1.05 * stalk.
      const float stalk = std::sqrt(std::min(1.0F, (static_cast<float>(above) + 0.5F) * heightStep));
      return 0.548F + stalk * (0.86F - 0.25F * stalk);
    };
    first = reliefAt(0);
    const float shown = tops;
    alignas(64) std::array<int, kRootRows> packed;
    const int count = std::min(kRootRows, (reach + kLanes) / kLanes * kLanes);
    for (int above = 0; above < count; ++above) {
      const float relief = reliefAt(above);
      const int share = static_cast<int>((relief + (1.0F - relief) * shown) * (kShareSteps / kRootRows) + 0.5F);
      packed[static_cast<std::size_t>(above)] = share * kRootRows + above;
    }
    for (int above = 0; above < count; ++above) {
      const auto at = static_cast<std::size_t>(above);
      roots[at] = static_cast<Root>(packed[at]);
    }
  }
};

/// What shows where no blade stands before it: the bare earth is not darkened.
void startRoots(const Shares& shares, const SoilBetween& soil, GrassRows& grass) {
  const Halves tops = Halves{} + static_cast<std::int16_t>(shares.tops * 32767.0F);
  const Halves rest = Halves{} + static_cast<std::int16_t>((1.0F - shares.first) * kShareSteps);
  const auto first = static_cast<std::int16_t>(shares.first * (0.5F * kShareSteps) + 0.25F * kRootRows);
  for (int i = 0; i < kTile; i += kHalves) {
    const Halves cover = least(grassAt(soil, i), Halves{} + std::int16_t{8191}) * 4;
    const Halves share = first + upper(most(32767 - cover, tops), rest);
    store(reinterpret_cast<UnsignedHalves>(share * 2) & static_cast<Root>(~kRootMask), grass.roots.data() + i);
  }
}

}  // namespace

void findRoots(const Row& at, int reach, const SoilBetween& soil, GrassRows& grass) {
  const Shares shares(at, reach);
  startRoots(shares, soil, grass);
  Root* __restrict roots = grass.roots.data();
  const int row = at.row;
  const auto wanted = static_cast<std::int16_t>(row);
  // Four rows at once, so that the roots stay in registers; a row that does not reach changes nothing.
  std::array<int, 4> rows{};
  std::size_t found = 0;
  const auto search = [&] {
    const auto tops = [&](std::size_t i) { return grass.tops.data() + (rows[i] & (kRootRows - 1)) * kTile; };
    const std::int16_t* __restrict a = tops(0);
    const std::int16_t* __restrict b = tops(1);
    const std::int16_t* __restrict c = tops(2);
    const std::int16_t* __restrict d = tops(3);
    const Root rootA = shares.roots[static_cast<std::size_t>(rows[0] - row)];
    const Root rootB = shares.roots[static_cast<std::size_t>(rows[1] - row)];
    const Root rootC = shares.roots[static_cast<std::size_t>(rows[2] - row)];
    const Root rootD = shares.roots[static_cast<std::size_t>(rows[3] - row)];
    for (int i = 0; i < kTile; ++i) {
      Root root = a[i] <= wanted ? rootA : roots[i];
      root = b[i] <= wanted ? rootB : root;
      root = c[i] <= wanted ? rootC : root;
      roots[i] = d[i] <= wanted ? rootD : root;
    }
  };
  for (int nearer = row + 1; nearer <= row + reach; ++nearer) {
    if (grass.highest[static_cast<std::size_t>(nearer & (kRootRows - 1))] > row) continue;
    rows[found++] = nearer;
    if (found == rows.size()) {
      search();
      found = 0;
    }
  }
  if (found > 0) {
    std::fill(rows.begin() + static_cast<std::ptrdiff_t>(found), rows.end(), rows[found - 1]);
    search();
  }
}

}  // namespace grove::objects::ground
