#include "objects/ground/ground_rows.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace grove::objects::ground {
namespace {

/// The meadow lies turned against the axes, so that its tiles do not line up with the path.
constexpr float kTurnCosine = 0.81915F;
constexpr float kTurnSine = 0.57358F;

struct Line {
  float x, y, stepX, stepY;  // at the tile's first column, and per column
};

/// Where a row's pixels lie in the meadow's texels of level 0.
Line meadowLine(const Frame& frame, float depth, float ahead, int firstColumn, float texelsPerMetre) {
  const float side = frame.firstSide + static_cast<float>(firstColumn) * frame.sideStep;
  const float x = frame.eyeX + depth * (ahead * frame.forwardX + side * frame.sideX);
  const float z = frame.eyeZ + depth * (ahead * frame.forwardZ + side * frame.sideZ);
  const float stepX = depth * frame.sideStep * frame.sideX;
  const float stepZ = depth * frame.sideStep * frame.sideZ;
  return {(x * kTurnCosine - z * kTurnSine) * texelsPerMetre, (x * kTurnSine + z * kTurnCosine) * texelsPerMetre,
          (stepX * kTurnCosine - stepZ * kTurnSine) * texelsPerMetre,
          (stepX * kTurnSine + stepZ * kTurnCosine) * texelsPerMetre};
}

/// Two neighbouring levels of a pyramid that repeats. Pixels alternate between the two in a fixed pattern, the more of
/// them coarser the larger `share` is, so that no line shows where the level changes.
struct TiledLevels {
  const std::uint32_t* __restrict texels;
  int coarseOffset;
  int shift;  // log2 of the finer one's size
  int mask;   // of the finer one's coordinates
  float scale;
  float share;

  TiledLevels(const Pyramid& pyramid, const MeadowSampling& sampling)
      : texels(pyramid.level(sampling.level)),
        coarseOffset(static_cast<int>(pyramid.level(sampling.level + 1) - texels)),
        shift(std::countr_zero(static_cast<unsigned>(pyramid.size())) - sampling.level),
        mask((1 << shift) - 1),
        scale(1.0F / static_cast<float>(1 << sampling.level)),
        share(sampling.coarser * 16.0F) {}

  /// At level 0's coordinates; `turn` is any number that differs between neighbouring pixels.
  [[nodiscard]] std::uint32_t at(float x, float y, int turn) const {
    const int column = static_cast<int>(std::floor(x * scale)) & mask;
    const int line = static_cast<int>(std::floor(y * scale)) & mask;
    const int coarse = coarseOffset + ((line >> 1) << (shift - 1)) + (column >> 1);
    const int soft = static_cast<float>((turn * 7) & 15) + 0.5F < share ? 1 : 0;
    const int fine = (line << shift) + column;
    return texels[fine + (coarse - fine) * soft];
  }
};

inline float channel(std::uint32_t texel, unsigned shift) {
  return static_cast<float>(static_cast<int>((texel >> shift) & 0xFFU));
}

inline float mixChannel(const std::array<std::uint32_t, 4>& t, unsigned shift, float fx, float fy) {
  const float top = channel(t[0], shift) + (channel(t[1], shift) - channel(t[0], shift)) * fx;
  const float bottom = channel(t[2], shift) + (channel(t[3], shift) - channel(t[2], shift)) * fx;
  return (top + (bottom - top) * fy) * (1.0F / 255.0F);
}

struct Albedo {
  float r, g, b;
};
constexpr Albedo kLush{0.105F, 0.172F, 0.045F};
constexpr Albedo kDry{0.265F, 0.222F, 0.085F};
constexpr Albedo kEarth{0.250F, 0.165F, 0.100F};

}  // namespace

Row rowAt(const Frame& frame, int row) noexcept {
  const auto at = static_cast<float>(row);
  const float inverse = frame.firstInverse + at * frame.inverseStep;
  const float ahead = frame.firstAhead + at * frame.aheadStep;
  return {row, 1.0F / inverse, ahead, -frame.eyeY * inverse, std::max(0.0F, frame.focal * ahead * inverse)};
}

// hazeColour() is a constant and a glow that grows with the sun's cosine: both are read off its one definition.
Daylight::Daylight()
    : sun(world::sunDirection()),
      sunColour(world::sunColour()),
      sky(world::ambient(world::Vec3(0, 1, 0))),
      hazeAside(world::hazeColour(-sun)),
      hazeGlow(world::hazeColour(sun) - hazeAside),
      logTransmittance(std::log(1.0F - world::hazeAmount(100.0F)) / 100.0F) {}

ToneTable::ToneTable() : bytes{} {
  for (std::size_t i = 0; i < kEntries; ++i) {
    bytes[i] = static_cast<std::uint32_t>(world::toDisplay((static_cast<float>(i) + 0.5F) / kScale) * 255.0F + 0.5F);
  }
}

void sampleClearing(const Frame& frame, const Row& row, int firstColumn, const Clearing& clearing, int level,
                    const Daylight& daylight, std::span<const world::PointLight> lights, CoarseRow& out) {
  const std::uint32_t* __restrict texels = clearing.pyramid.level(level);
  const int size = clearing.pyramid.size() >> level;
  const float texelsPerMetre = static_cast<float>(size) / clearing.metres;
  const float middle = 0.5F * static_cast<float>(size) - 0.5F;
  const auto last = static_cast<float>(size - 1);

  const Daylight light = daylight;
  const world::Vec3 sun = light.sun;
  const float sunFlat = std::sqrt(sun.x * sun.x + sun.z * sun.z);
  const float sideX = frame.sideX * row.depth;
  const float sideZ = frame.sideZ * row.depth;
  const float x0 = frame.eyeX + row.depth * row.ahead * frame.forwardX;
  const float z0 = frame.eyeZ + row.depth * row.ahead * frame.forwardZ;
  const float towards = sun.x * row.ahead * frame.forwardX + sun.z * row.ahead * frame.forwardZ + sun.y * row.rise;
  const float towardsSide = sun.x * frame.sideX + sun.z * frame.sideZ;
  const float square = row.ahead * row.ahead + row.rise * row.rise;

  alignas(64) std::array<float, kCoarsePadded> lampR{};
  alignas(64) std::array<float, kCoarsePadded> lampG{};
  alignas(64) std::array<float, kCoarsePadded> lampB{};
  const float firstSide = frame.firstSide + static_cast<float>(firstColumn) * frame.sideStep;
  const float coarseStep = frame.sideStep * kCoarse;
  for (const world::PointLight& lamp : lights) {
    const float up = lamp.position.y;
    for (int i = 0; i < kCoarsePadded; ++i) {
      const float side = firstSide + static_cast<float>(i) * coarseStep;
      const float dx = lamp.position.x - (x0 + side * sideX);
      const float dz = lamp.position.z - (z0 + side * sideZ);
      const float away = dx * dx + dz * dz + up * up + 0.05F;
      // Grass stands up and catches light that the plane would not.
      const float strength = (0.35F + 0.65F * up / std::sqrt(away)) / away;
      const auto at = static_cast<std::size_t>(i);
      lampR[at] += lamp.colour.r * strength;
      lampG[at] += lamp.colour.g * strength;
      lampB[at] += lamp.colour.b * strength;
    }
  }

  for (int i = 0; i < kCoarsePadded; ++i) {
    const auto at = static_cast<std::size_t>(i);
    const float side = firstSide + static_cast<float>(i) * coarseStep;
    const float x = std::clamp((x0 + side * sideX) * texelsPerMetre + middle, 0.0F, last - 0.001F);
    const float y = std::clamp((z0 + side * sideZ) * texelsPerMetre + middle, 0.0F, last - 0.001F);
    const int column = static_cast<int>(x);
    const int line = static_cast<int>(y);
    const float fx = x - static_cast<float>(column);
    const float fy = y - static_cast<float>(line);
    const int index = line * size + column;
    const std::array<std::uint32_t, 4> t{texels[index], texels[index + 1], texels[index + size],
                                         texels[index + size + 1]};
    const float lit = mixChannel(t, 0, fx, fy);
    const float open = mixChannel(t, 8, fx, fy);
    const float dry = mixChannel(t, 16, fx, fy);
    const float grass = mixChannel(t, 24, fx, fy);

    const float length = std::sqrt(square + side * side);
    const float cosine = std::max(0.0F, (towards + side * towardsSide) / length);
    const float c4 = cosine * cosine * cosine * cosine;
    const float c16 = c4 * c4 * c4 * c4;
    const float cover = std::min(1.0F, grass * 4.0F);
    // Blades let the light through towards the eye when it looks into the sun, and shine dully when it looks away.
    const float away = 0.5F - 0.5F * (towards + side * towardsSide) / (length * sunFlat);
    const float direct = lit * (0.26F + cover * (0.14F + 0.42F * away + 1.05F * c4 + 0.85F * c16));
    const float shade = open * open * (1.0F - 0.15F * cover);
    const float r = kEarth.r + cover * (kLush.r + dry * (kDry.r - kLush.r) - kEarth.r);
    const float g = kEarth.g + cover * (kLush.g + dry * (kDry.g - kLush.g) - kEarth.g);
    const float b = kEarth.b + cover * (kLush.b + dry * (kDry.b - kLush.b) - kEarth.b);
    out.radiance[0][at] = r * (light.sunColour.r * direct + light.sky.r * shade + lampR[at]);
    out.radiance[1][at] = g * (light.sunColour.g * direct + light.sky.g * shade + lampG[at]);
    out.radiance[2][at] = b * (light.sunColour.b * direct + light.sky.b * shade + lampB[at]);

    const float transmittance = std::exp(light.logTransmittance * row.depth * length);
    const float glow = (0.36F * c4 + 0.30F * c16) * (1.0F / 0.66F);
    const float air = 1.0F - transmittance;
    out.haze[0][at] = air * (light.hazeAside.r + light.hazeGlow.r * glow);
    out.haze[1][at] = air * (light.hazeAside.g + light.hazeGlow.g * glow);
    out.haze[2][at] = air * (light.hazeAside.b + light.hazeGlow.b * glow);
    out.transmittance[at] = transmittance;
    out.grass[at] = grass;
  }
}

namespace {

void refineOne(const std::array<float, kCoarsePadded>& coarse, std::array<float, kTile>& fine) {
  for (std::size_t i = 0; i + 1 < kCoarseSamples; ++i) {
    const float from = coarse[i];
    const float step = (coarse[i + 1] - from) * (1.0F / kCoarse);
    for (std::size_t j = 0; j < kCoarse; ++j) fine[i * kCoarse + j] = from + step * static_cast<float>(j);
  }
}

}  // namespace

void refine(const CoarseRow& coarse, FineRow& fine) {
  for (std::size_t i = 0; i < 3; ++i) {
    refineOne(coarse.radiance[i], fine.radiance[i]);
    refineOne(coarse.haze[i], fine.haze[i]);
  }
  refineOne(coarse.transmittance, fine.transmittance);
  refineOne(coarse.grass, fine.grass);
}

void growGrass(const Frame& frame, const Row& row, int firstColumn, const Meadow& meadow,
               const MeadowSampling& sampling, const FineRow& fine, GrassRows& grass) {
  const TiledLevels texture(meadow.pyramid, sampling);
  const int turn = row.row * 5;
  const Line line =
      meadowLine(frame, row.depth, row.ahead, firstColumn, static_cast<float>(meadow.pyramid.size()) / meadow.metres);
  const float tallest = row.pixelsPerMetre * kTallest * (1.0F / 255.0F);
  const auto base = static_cast<float>(row.row);
  std::int16_t* __restrict tops = grass.tops[static_cast<std::size_t>(row.row & (kRootRows - 1))].data();
  const float* __restrict heights = fine.grass.data();
  // Two loops: one that mixes 32-bit gathers and 16-bit stores makes the compiler gather by 64-bit indices.
  alignas(64) std::array<float, kTile> top;
  float* __restrict levels = top.data();
  for (int i = 0; i < kTile; ++i) {
    const float x = line.x + static_cast<float>(i) * line.stepX;
    const float y = line.y + static_cast<float>(i) * line.stepY;
    levels[i] = base - channel(texture.at(x, y, turn + i), 24) * heights[i] * tallest + 0.5F;
  }
  for (int i = 0; i < kTile; ++i) tops[i] = static_cast<std::int16_t>(static_cast<int>(levels[i]));
}

void findRoots(int row, int reach, GrassRows& grass) {
  std::int16_t* __restrict roots = grass.roots.data();
  std::fill_n(roots, kTile, static_cast<std::int16_t>(row));
  const auto wanted = static_cast<std::int16_t>(row);
  for (int nearer = row + 1; nearer <= row + reach; ++nearer) {
    const std::int16_t* __restrict tops = grass.tops[static_cast<std::size_t>(nearer & (kRootRows - 1))].data();
    const auto here = static_cast<std::int16_t>(nearer);
    for (int i = 0; i < kTile; ++i) roots[i] = tops[i] <= wanted ? here : roots[i];
  }
}

namespace {

template <int kTaps>
void shade(const Frame& frame, const Row& row, int firstColumn, const Meadow& meadow, const MeadowSampling& sampling,
           const FineRow& fine, const GrassRows& grass, const ToneTable& tone, std::uint32_t* __restrict colour,
           float* __restrict depth) {
  const TiledLevels texture(meadow.pyramid, sampling);
  const int turn = row.row * 5;
  const float texelsPerMetre = static_cast<float>(meadow.pyramid.size()) / meadow.metres;
  const float forwardX = (frame.forwardX * kTurnCosine - frame.forwardZ * kTurnSine) * texelsPerMetre;
  const float forwardY = (frame.forwardX * kTurnSine + frame.forwardZ * kTurnCosine) * texelsPerMetre;
  const float sideX = (frame.sideX * kTurnCosine - frame.sideZ * kTurnSine) * texelsPerMetre;
  const float sideY = (frame.sideX * kTurnSine + frame.sideZ * kTurnCosine) * texelsPerMetre;
  const float eyeX = (frame.eyeX * kTurnCosine - frame.eyeZ * kTurnSine) * texelsPerMetre;
  const float eyeY = (frame.eyeX * kTurnSine + frame.eyeZ * kTurnCosine) * texelsPerMetre;
  const float firstSide = frame.firstSide + static_cast<float>(firstColumn) * frame.sideStep;
  const std::uint32_t* __restrict table = tone.bytes.data();
  // As in growGrass(), 16-bit values stay out of the loop that gathers.
  alignas(64) std::array<float, kTile> rootRows;
  float* __restrict roots = rootRows.data();
  for (std::size_t i = 0; i < kTile; ++i) roots[i] = static_cast<float>(grass.roots[i]);
  const float* __restrict radianceR = fine.radiance[0].data();
  const float* __restrict radianceG = fine.radiance[1].data();
  const float* __restrict radianceB = fine.radiance[2].data();
  const float* __restrict hazeR = fine.haze[0].data();
  const float* __restrict hazeG = fine.haze[1].data();
  const float* __restrict hazeB = fine.haze[2].data();
  const float* __restrict transmittance = fine.transmittance.data();
  const float* __restrict heights = fine.grass.data();
  const float focal = frame.focal;
  const float inverseStep = frame.inverseStep;
  const float firstInverse = frame.firstInverse;
  const float firstAhead = frame.firstAhead;
  const float aheadStep = frame.aheadStep;
  const float sideStep = frame.sideStep;
  const auto thisRow = static_cast<float>(row.row);
  const float tapStep = 1.0F / static_cast<float>(kTaps);
  // Where blades are shorter than a pixel only their tops are seen.
  const float streak = row.pixelsPerMetre * (0.35F * kTallest);
  const float tops = std::clamp(1.5F - 0.5F * streak, 0.0F, 1.0F);
  const float inverseTallest = 1.0F / (0.62F * kTallest);
  constexpr float kLimit = static_cast<float>(ToneTable::kEntries - 1);

  for (int i = 0; i < kTile; ++i) {
    const float root = roots[i];
    const float inverse = firstInverse + root * inverseStep;
    const float distance = 1.0F / inverse;
    const float ahead = firstAhead + root * aheadStep;
    const float side = firstSide + static_cast<float>(i) * sideStep;
    const float x = eyeX + distance * (ahead * forwardX + side * sideX);
    const float y = eyeY + distance * (ahead * forwardY + side * sideY);
    const float along = -distance * distance * inverseStep;  // metres of depth per row
    float red = 0.0F;
    float green = 0.0F;
    float blue = 0.0F;
    for (int tap = 0; tap < kTaps; ++tap) {
      const float shift = ((static_cast<float>(tap) + 0.5F) * tapStep - 0.5F) * along;
      const float tapX = x + shift * (ahead * forwardX + side * sideX);
      const float tapY = y + shift * (ahead * forwardY + side * sideY);
      const std::uint32_t texel = texture.at(tapX, tapY, turn + i + tap * 9);
      red += channel(texel, 0);
      green += channel(texel, 8);
      blue += channel(texel, 16);
    }
    const float above = root - thisRow + 0.5F;
    const float metres = above / std::max(1e-3F, focal * ahead * inverse);
    const float height = std::min(1.0F, metres * inverseTallest);
    const float stood = std::min(1.0F, 4.0F * heights[i] + (root > thisRow ? 1.0F : 0.0F));
    const float relief = 0.30F + 1.05F * std::sqrt(height);
    const float mixed = relief + (1.0F - relief) * std::max(tops, 1.0F - stood);
    const float factor = mixed * transmittance[i] * (tapStep / 128.0F);
    const float r = red * factor * radianceR[i] + hazeR[i];
    const float g = green * factor * radianceG[i] + hazeG[i];
    const float b = blue * factor * radianceB[i] + hazeB[i];
    const std::uint32_t displayR = table[static_cast<int>(std::min(r * ToneTable::kScale, kLimit))];
    const std::uint32_t displayG = table[static_cast<int>(std::min(g * ToneTable::kScale, kLimit))];
    const std::uint32_t displayB = table[static_cast<int>(std::min(b * ToneTable::kScale, kLimit))];
    colour[i] = displayR | displayG << 8U | displayB << 16U | 0xFF000000U;
    depth[i] = distance;
  }
}

}  // namespace

void shadeRow(const Frame& frame, const Row& row, int firstColumn, const Meadow& meadow, const MeadowSampling& sampling,
              const FineRow& fine, const GrassRows& grass, const ToneTable& tone, std::uint32_t* colour, float* depth) {
  const auto run = sampling.taps == 1 ? shade<1> : sampling.taps == 2 ? shade<2> : shade<4>;
  run(frame, row, firstColumn, meadow, sampling, fine, grass, tone, colour, depth);
}

}  // namespace grove::objects::ground
