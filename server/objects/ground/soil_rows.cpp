#include "objects/ground/soil_rows.h"

#include <algorithm>
#include <cmath>

#include "objects/ground/halves.h"

namespace grove::objects::ground {
namespace {

struct Albedo {
  float r, g, b;
};
constexpr Albedo kLush{0.105F, 0.172F, 0.045F};
constexpr Albedo kDry{0.215F, 0.208F, 0.076F};
constexpr Albedo kEarth{0.250F, 0.165F, 0.100F};

/// Mist lies on the far meadow, so that it has no visible end: none up to kMistBegins, and most of it at kFarthest.
constexpr float kMistBegins = 28.0F;
constexpr float kMist = 0.80F;

/// Where the parabola meets the tone curve: roots of albedo, relative to the soil's, from shaded stalks to lit tips.
constexpr float kDark = 0.40F;
constexpr float kMiddle = 0.85F;
constexpr float kBright = 1.40F;

inline float channel(std::uint32_t texel, unsigned shift) {
  return static_cast<float>(static_cast<int>((texel >> shift) & 0xFFU));
}

inline float mixChannel(const std::array<std::uint32_t, 4>& t, unsigned shift, float fx, float fy) {
  const float top = channel(t[0], shift) + (channel(t[1], shift) - channel(t[0], shift)) * fx;
  const float bottom = channel(t[2], shift) + (channel(t[3], shift) - channel(t[2], shift)) * fx;
  return (top + (bottom - top) * fy) * (1.0F / 255.0F);
}

/// Of each sample.
struct Light {
  alignas(64) SoilSamples red{};
  alignas(64) SoilSamples green{};
  alignas(64) SoilSamples blue{};
};

/// The points of a row's samples: those of the first column and what a metre of `side` adds.
struct Line {
  float x, z, sideX, sideZ, firstSide, sideStep;
};

void addLamp(const Line& line, const world::PointLight& lamp, Light& light) {
  const float up = lamp.position.y;
  for (int i = 0; i < kCoarsePadded; ++i) {
    const float side = line.firstSide + static_cast<float>(i) * line.sideStep;
    const float dx = lamp.position.x - (line.x + side * line.sideX);
    const float dz = lamp.position.z - (line.z + side * line.sideZ);
    const float away = dx * dx + dz * dz + up * up + 0.05F;
    // Grass stands up and catches light that the plane would not.
    const float strength = (0.35F + 0.65F * up / std::sqrt(away)) / away;
    const auto at = static_cast<std::size_t>(i);
    light.red[at] += lamp.colour.r * strength;
    light.green[at] += lamp.colour.g * strength;
    light.blue[at] += lamp.colour.b * strength;
  }
}

/// What is displayed of blades whose root of albedo is `root`. The loops are apart, and write to arrays that nothing
/// else can point at, or the compiler would not gather.
void show(const SoilSamples& radiance, const SoilSamples& haze, float root, const ToneTable& tone, SoilSamples& out) {
  alignas(64) std::array<int, kCoarsePadded> index;
  alignas(64) std::array<float, kCoarsePadded> shown;
  const float scale = root * root * ToneTable::kScale;
  constexpr int kLimit = ToneTable::kEntries - 1;
  const float* __restrict table = tone.levels.data();
  for (std::size_t i = 0; i < kCoarsePadded; ++i) {
    index[i] = std::min(static_cast<int>(haze[i] * ToneTable::kScale + radiance[i] * scale), kLimit);
  }
  for (std::size_t i = 0; i < kCoarsePadded; ++i) shown[i] = table[index[i]];
  std::copy(shown.begin(), shown.end(), out.begin());
}

/// Turns radiance and haze into the parabola of what is displayed.
void develop(const SoilSamples& radiance, const SoilSamples& haze, const ToneTable& tone, SampledSoil::Channel& out) {
  alignas(64) SoilSamples dark;
  alignas(64) SoilSamples middle;
  alignas(64) SoilSamples bright;
  show(radiance, haze, kDark, tone, dark);
  show(radiance, haze, kMiddle, tone, middle);
  show(radiance, haze, kBright, tone, bright);
  for (std::size_t i = 0; i < kCoarsePadded; ++i) {
    const float first = (middle[i] - dark[i]) * (1.0F / (kMiddle - kDark));
    const float second = (bright[i] - middle[i]) * (1.0F / (kBright - kMiddle));
    const float square = (second - first) * (1.0F / (kBright - kDark));
    const float slope = first - square * (kDark + kMiddle);
    out.square[i] = square;
    out.slope[i] = slope;
    out.base[i] = dark[i] - kDark * (slope + kDark * square) + 0.5F;
  }
}

}  // namespace

void sampleSoil(const Frame& frame, const Row& row, int firstColumn, const Clearing& clearing, int level,
                const Daylight& daylight, const ToneTable& tone, std::span<const world::PointLight> lights,
                SampledSoil& out) {
  const std::uint32_t* __restrict texels = clearing.pyramid.level(level);
  const int size = clearing.pyramid.size() >> level;
  const float texelsPerMetre = static_cast<float>(size) / clearing.metres;
  const float middle = 0.5F * static_cast<float>(size) - 0.5F;
  const auto last = static_cast<float>(size - 1);

  const Daylight light = daylight;
  const world::Vec3 sun = light.sun;
  const float inverseSunFlat = 1.0F / std::sqrt(sun.x * sun.x + sun.z * sun.z);
  const float towards = sun.x * row.ahead * frame.forwardX + sun.z * row.ahead * frame.forwardZ + sun.y * row.rise;
  const float towardsSide = sun.x * frame.sideX + sun.z * frame.sideZ;
  const float square = row.ahead * row.ahead + row.rise * row.rise;
  const float far = std::clamp((row.depth - kMistBegins) / (kFarthest - kMistBegins), 0.0F, 1.0F);
  const float clear = 1.0F - kMist * far * far * (3.0F - 2.0F * far);

  const Line line{frame.eyeX + row.depth * row.ahead * frame.forwardX,
                  frame.eyeZ + row.depth * row.ahead * frame.forwardZ,
                  frame.sideX * row.depth,
                  frame.sideZ * row.depth,
                  frame.firstSide + static_cast<float>(firstColumn) * frame.sideStep,
                  frame.sideStep * kCoarse};
  Light lamps;
  for (const world::PointLight& lamp : lights) addLamp(line, lamp, lamps);

  Light radiance;
  Light haze;
  for (int i = 0; i < kCoarsePadded; ++i) {
    const auto at = static_cast<std::size_t>(i);
    const float side = line.firstSide + static_cast<float>(i) * line.sideStep;
    const float x = std::clamp((line.x + side * line.sideX) * texelsPerMetre + middle, 0.0F, last - 0.001F);
    const float y = std::clamp((line.z + side * line.sideZ) * texelsPerMetre + middle, 0.0F, last - 0.001F);
    const int texelColumn = static_cast<int>(x);
    const int texelRow = static_cast<int>(y);
    const float fx = x - static_cast<float>(texelColumn);
    const float fy = y - static_cast<float>(texelRow);
    const int index = texelRow * size + texelColumn;
    const std::array<std::uint32_t, 4> t{texels[index], texels[index + 1], texels[index + size],
                                         texels[index + size + 1]};
    const float lit = mixChannel(t, 0, fx, fy);
    const float open = mixChannel(t, 8, fx, fy);
    const float dry = mixChannel(t, 16, fx, fy);
    const float grass = mixChannel(t, 24, fx, fy);

    const float length = std::sqrt(square + side * side);
    const float ray = (towards + side * towardsSide) / length;
    const float cosine = std::max(0.0F, ray);
    const float c4 = cosine * cosine * cosine * cosine;
    const float c16 = c4 * c4 * c4 * c4;
    const float cover = std::min(1.0F, grass * 4.0F);
    // Blades let the light through towards the eye when it looks into the sun, and shine dully when it looks away.
    const float away = 0.5F - 0.5F * ray * inverseSunFlat;
    const float direct = lit * (0.26F + cover * (0.14F + 0.42F * away + 1.05F * c4 + 0.85F * c16));
    const float shade = open * open * (1.0F - 0.15F * cover);
    const float r = kEarth.r + cover * (kLush.r + dry * (kDry.r - kLush.r) - kEarth.r);
    const float g = kEarth.g + cover * (kLush.g + dry * (kDry.g - kLush.g) - kEarth.g);
    const float b = kEarth.b + cover * (kLush.b + dry * (kDry.b - kLush.b) - kEarth.b);
    const float transmittance = clear * std::exp(light.logTransmittance * row.depth * length);
    radiance.red[at] = transmittance * r * (light.sunColour.r * direct + light.sky.r * shade + lamps.red[at]);
    radiance.green[at] = transmittance * g * (light.sunColour.g * direct + light.sky.g * shade + lamps.green[at]);
    radiance.blue[at] = transmittance * b * (light.sunColour.b * direct + light.sky.b * shade + lamps.blue[at]);

    const float glow = (0.36F * c4 + 0.30F * c16) * (1.0F / 0.66F);
    const float air = 1.0F - transmittance;
    haze.red[at] = air * (light.hazeAside.r + light.hazeGlow.r * glow);
    haze.green[at] = air * (light.hazeAside.g + light.hazeGlow.g * glow);
    haze.blue[at] = air * (light.hazeAside.b + light.hazeGlow.b * glow);
    out.grass[at] = grass;
  }
  develop(radiance.red, haze.red, tone, out.channels[0]);
  develop(radiance.green, haze.green, tone, out.channels[1]);
  develop(radiance.blue, haze.blue, tone, out.channels[2]);
}

namespace {

struct Scale {
  float factor;
  float least, most;  // so that no sum of products leaves 16 bits
};
constexpr Scale kBase{kSoilSteps, -12000.0F, 12000.0F};
constexpr Scale kSlope{1.0F / kSlopeStep, -8000.0F, 24000.0F};
constexpr Scale kSquare{1.0F / kSquareStep, -16000.0F, 8000.0F};
constexpr Scale kGrass{kMostGrass, 0.0F, kMostGrass};

inline int scaled(float value, Scale scale) {
  return static_cast<int>(std::clamp(value * scale.factor, scale.least, scale.most) + 32768.5F) - 32768;
}

/// Samples as pairs of 16-bit numbers.
using Pairs = std::array<std::uint32_t, kCoarsePadded + kLanes>;

void pack(const SoilSamples& low, const SoilSamples& high, Scale scale, Pairs& out) {
  for (std::size_t i = 0; i < out.size(); ++i) {
    out[i] = (static_cast<std::uint32_t>(scaled(low[i], scale)) & 0xFFFFU) |
             static_cast<std::uint32_t>(scaled(high[i], scale)) << 16U;
  }
}

constexpr int kColumns = kHalves / 2;
using Columns [[gnu::vector_size(kColumns * 4)]] = std::uint32_t;

/// Columns from `first` on, each straight between two of its tile's samples.
Halves between(const Pairs& pairs, int first) {
  constexpr std::uint32_t kEighth = 0x10001000U;
  static_assert(kCoarse == 8);
  Columns sample{};
  Columns column{};
  for (int lane = 0; lane < kColumns; ++lane) {
    sample[lane] = static_cast<std::uint32_t>(lane / kCoarse);
    column[lane] = static_cast<std::uint32_t>((first + lane) % kCoarse) * kEighth;
  }
  const auto samples = load<Columns>(pairs.data() + first / kCoarse);
  const auto left = reinterpret_cast<Halves>(__builtin_shuffle(samples, sample));
  const auto right = reinterpret_cast<Halves>(__builtin_shuffle(samples, sample + 1U));
  return left + part(right - left, reinterpret_cast<Halves>(column));
}

void spread(const SoilSamples& low, const SoilSamples& high, Scale scale, FineSoil::Line& out) {
  alignas(64) Pairs pairs;
  pack(low, high, scale, pairs);
  for (int first = 0; first < kTile; first += kColumns) store(between(pairs, first), out.data() + 2 * first);
}

template <std::size_t kCount>
void stepBetween(const std::array<std::int16_t, kCount>& first, const std::array<std::int16_t, kCount>& last, int rows,
                 std::array<std::int16_t, kCount>& out) {
  static_assert(kCount % kHalves == 0);
  const auto shift = static_cast<std::int16_t>(rows / 2);
  for (std::size_t i = 0; i < kCount; i += kHalves) {
    const Halves way = load<Halves>(last.data() + i) - load<Halves>(first.data() + i);
    store((way + shift) >> shift, out.data() + i);
  }
}

void stepChannels(const FineSoil::Channels& first, const FineSoil::Channels& last, int rows, FineSoil::Channels& out) {
  stepBetween(first.base, last.base, rows, out.base);
  stepBetween(first.slope, last.slope, rows, out.slope);
  stepBetween(first.square, last.square, rows, out.square);
}

constexpr SoilSamples filledWith(float value) {
  SoilSamples samples{};
  samples.fill(value);
  return samples;
}

}  // namespace

void spreadSoil(const SampledSoil& samples, FineSoil& out) {
  static constexpr SoilSamples kOpaque = filledWith(255.9F);
  static constexpr SoilSamples kNone = filledWith(0.0F);
  const auto& [red, green, blue] = samples.channels;
  spread(red.base, blue.base, kBase, out.low.base);
  spread(red.slope, blue.slope, kSlope, out.low.slope);
  spread(red.square, blue.square, kSquare, out.low.square);
  spread(green.base, kOpaque, kBase, out.high.base);
  spread(green.slope, kNone, kSlope, out.high.slope);
  spread(green.square, kNone, kSquare, out.high.square);
  FineSoil::Line twice;
  spread(samples.grass, samples.grass, kGrass, twice);
  for (std::size_t i = 0; i < kTile; ++i) out.grass[i] = twice[2 * i];
}

void stepSoil(const FineSoil& first, const FineSoil& last, int rows, FineSoil& out) {
  stepChannels(first.low, last.low, rows, out.low);
  stepChannels(first.high, last.high, rows, out.high);
  stepBetween(first.grass, last.grass, rows, out.grass);
}

}  // namespace grove::objects::ground
