#include "raster/soften_kernels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "each_target.h"

namespace grove::raster {
namespace {

constexpr int kWidths[] = {1, 2, 3, 7, 16, 17, 33, 100};
constexpr std::uint32_t kBeyond = 0xDEADBEEFU;

using Row = std::vector<std::uint32_t>;

/// With one value beyond the end.
Row colours(int width, std::mt19937& random) {
  Row row;
  for (int i = 0; i < width; ++i) row.push_back(static_cast<std::uint32_t>(random()));
  row.push_back(kBeyond);
  return row;
}

/// The exact mean may be rounded both ways.
void expectMean(std::uint32_t before, std::uint32_t here, std::uint32_t after, Softening softening, std::uint32_t out) {
  const double weight = softening == Softening::kHalf ? 2.0 : 6.0;
  for (unsigned shift = 0; shift < 32; shift += 8) {
    const auto of = [&](std::uint32_t colour) { return static_cast<double>(colour >> shift & 0xFFU); };
    const double mean = (of(before) + weight * of(here) + of(after)) / (weight + 2.0);
    EXPECT_LE(std::abs(of(out) - mean), 1.0);
  }
}

/// Fails if a target takes another neighbour or weight, mixes channels, or writes beyond the end.
TEST(SoftenKernels, AreMeansOnEveryTarget) {
  tests::onEachTarget([] {
    std::mt19937 random(3);
    for (const Softening softening : {Softening::kHalf, Softening::kQuarter}) {
      for (const int width : kWidths) {
        const Row above = colours(width, random);
        const Row here = colours(width, random);
        const Row below = colours(width, random);
        Row down(here.size(), kBeyond);
        softenDown(above.data(), here.data(), below.data(), width, softening, down.data());
        Row across(here.size(), kBeyond);
        softenAcross(here.data(), width, softening, across.data());
        const auto last = static_cast<std::size_t>(width) - 1;
        for (std::size_t x = 0; x <= last; ++x) {
          expectMean(above[x], here[x], below[x], softening, down[x]);
          expectMean(here[x == 0 ? 0 : x - 1], here[x], here[std::min(x + 1, last)], softening, across[x]);
        }
        EXPECT_EQ(down.back(), kBeyond);
        EXPECT_EQ(across.back(), kBeyond);
      }
    }
  });
}

/// Fails if rounding makes a plain area darker or brighter.
TEST(SoftenKernels, KeepPlainColours) {
  tests::onEachTarget([] {
    for (const Softening softening : {Softening::kHalf, Softening::kQuarter}) {
      const Row row(40, 0xFF7F0180U);
      Row out(row.size());
      softenAcross(row.data(), 40, softening, out.data());
      EXPECT_EQ(out, row);
      softenDown(row.data(), row.data(), row.data(), 40, softening, out.data());
      EXPECT_EQ(out, row);
    }
  });
}

/// Fails if a target gives a depth to an empty pixel, changes one, or misses a neighbour at an end of the row.
TEST(SoftenKernels, FringesHaveTheNearestDepthOnEveryTarget) {
  tests::onEachTarget([] {
    std::mt19937 random(5);
    const auto depths = [&](int width) {
      std::vector<float> row;
      row.reserve(static_cast<std::size_t>(width));
      for (int i = 0; i < width; ++i) {
        row.push_back(random() % 2 == 0 ? world::kInfiniteDepth : static_cast<float>(random() % 64));
      }
      return row;
    };
    for (const int width : kWidths) {
      const std::vector<float> above = depths(width);
      const std::vector<float> here = depths(width);
      const std::vector<float> below = depths(width);
      std::vector<float> wide(here.size());
      nearestAcross(here.data(), width, wide.data());
      const auto last = here.size() - 1;
      for (std::size_t x = 0; x <= last; ++x) {
        EXPECT_EQ(wide[x], std::min({here[x == 0 ? 0 : x - 1], here[x], here[std::min(x + 1, last)]})) << width;
      }
      Row colour = colours(width, random);
      for (std::uint32_t& each : colour) each = random() % 2 == 0 ? each & 0x00FFFFFFU : each | 0x01000000U;
      std::vector<float> deepened = here;
      deepenFringe(above.data(), wide.data(), below.data(), colour.data(), width, deepened.data());
      for (std::size_t x = 0; x <= last; ++x) {
        const bool isFringe = here[x] == world::kInfiniteDepth && colour[x] >> 24U != 0;
        EXPECT_EQ(deepened[x], isFringe ? std::min({above[x], wide[x], below[x]}) : here[x]) << width;
      }
    }
  });
}

}  // namespace
}  // namespace grove::raster
