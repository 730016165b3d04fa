#include "objects/ground/frontend/grow_kernels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <vector>

#include "each_target.h"
#include "objects/ground/frontend/relief/relief_kernels.h"

namespace grove::objects::ground {
namespace {

constexpr int kGrassTexels = 64;
constexpr float kMetres = 2.0F;

Pyramid noise() {
  std::mt19937 random(4);
  std::vector<std::uint32_t> texels(kGrassTexels * kGrassTexels);
  std::ranges::generate(texels, random);
  return {kGrassTexels, std::move(texels)};
}

/// One sample of the ray through a column, row by row of the texture as it was before it was cut into blocks.
std::uint32_t sampleAt(const Pyramid& plain, const Frame& frame, const Row& row, const MeadowSampling& sampling,
                       int tap, int firstColumn, int column) {
  const double share = (tap + 0.5) / sampling.taps - 0.5;
  const double depth = row.depth - share * row.depth * row.depth * frame.inverseStep;
  const double side = frame.firstSide + (firstColumn + column) * static_cast<double>(frame.sideStep);
  const double x = frame.eyeX + depth * (row.ahead * frame.forwardX + side * frame.sideX);
  const double z = frame.eyeZ + depth * (row.ahead * frame.forwardZ + side * frame.sideZ);
  const bool coarser = static_cast<float>((row.row * 5 + tap * 9 + column) * 7 % 16) + 0.5F < sampling.coarser * 16.0F;
  const int level = sampling.level + (coarser ? 1 : 0);
  const int size = kGrassTexels >> level;
  const auto texel = [&](double metres) {
    const double turns = metres / static_cast<double>(kMetres);
    return static_cast<int>((turns - std::floor(turns)) * size) % size;
  };
  return plain.level(level)[texel(x * 0.57358 + z * 0.81915) * size + texel(x * 0.81915 - z * 0.57358)];
}

std::uint32_t mean(std::uint32_t into, std::uint32_t other) {
  std::uint32_t result = into & 0xFF000000U;
  for (std::uint32_t shift = 0; shift < 24; shift += 8) {
    result |= (((into >> shift) & 0xFFU) + ((other >> shift) & 0xFFU)) / 2 << shift;
  }
  return result;
}

struct Case {
  int row;
  int firstColumn;
  MeadowSampling sampling;
};

/// Tolerance: of 320 pixels three may fall to the texel beside, for their places are rounded; tops by one row.
TEST(GrowKernels, MatchesScalarOnEveryTarget) {
  const Pyramid plain = noise();
  const Meadow meadow{plain.inBlocks(), kMetres, kTallest};
  const world::Camera camera{
      .pose = {.position = {-3.0F, 1.7F, 2.0F}, .yaw = 0.6F, .pitch = -0.3F}, .width = 1280, .height = 720};
  const Frame frame = frameOf(camera);
  const auto soil = std::make_unique<FineSoil>();
  const auto step = std::make_unique<FineSoil>();
  for (std::size_t column = 0; column < kTile; ++column) {
    soil->grass[column] = static_cast<std::int16_t>(column * 50);
    step->grass[column] = static_cast<std::int16_t>(column * 25);
  }
  tests::onEachTarget([&] {
    const auto grass = std::make_unique<GrassRows>();
    for (const Case& at : {Case{250, 0, {4, 2, 0.6F}}, Case{401, 640, {2, 1, 0.0F}}, Case{719, 960, {1, 0, 0.97F}}}) {
      const Row row = rowAt(frame, at.row);
      GroundRow ground;
      findGround(frame, {}, at.row, at.firstColumn, nullptr, ground);
      growGrass(frame, ground, meadow, at.sampling, {*soil, *step, 2}, *grass);
      const auto slot = static_cast<std::size_t>(at.row % kRootRows);
      int strayed = 0;
      std::int16_t highest = static_cast<std::int16_t>(at.row);
      for (int column = 0; column < kTile; ++column) {
        const auto tap = [&](int index) {
          return sampleAt(plain, frame, row, at.sampling, index, at.firstColumn, column);
        };
        std::uint32_t expected = tap(0);
        if (at.sampling.taps == 2) expected = mean(expected, tap(1));
        if (at.sampling.taps == 4) expected = mean(mean(expected, tap(1)), mean(tap(2), tap(3)));
        const std::size_t index = slot * kTile + static_cast<std::size_t>(column);
        const std::uint32_t texel = grass->texels[index];
        if (texel != expected) ++strayed;
        const float height = static_cast<float>(texel >> 24U) / 255.0F * static_cast<float>(column) * 100.0F / 65536.0F;
        const float rise = height * 2.0F * std::min(254.0F, row.pixelsPerMetre * kTallest);
        ASSERT_NEAR(static_cast<float>(grass->tops[index]), static_cast<float>(at.row) - rise, 1.1F) << column;
        highest = std::min(highest, grass->tops[index]);
      }
      EXPECT_LE(strayed, 3) << at.row;
      EXPECT_EQ(grass->highest[slot], highest) << at.row;
    }
  });
}

}  // namespace
}  // namespace grove::objects::ground
