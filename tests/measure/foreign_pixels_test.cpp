#include "measure/foreign_pixels.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

namespace grove::measure {
namespace {

constexpr int kForeignWidth = 40;
constexpr int kForeignHeight = 30;
constexpr std::uint32_t kForeignGrass = 0xFF206040U;
constexpr std::uint32_t kForeignSoil = 0xFF205890U;
constexpr std::uint32_t kForeignLikeGrass = 0xFF206060U;  // kForeignContrast redder
constexpr std::uint32_t kForeignBetween = 0xFF205C68U;

struct ForeignFilm {
  std::vector<std::uint32_t> colour =
      std::vector<std::uint32_t>(std::size_t{kForeignWidth} * kForeignHeight, kForeignGrass);

  void set(int x, int y, std::uint32_t value) {
    colour[static_cast<std::size_t>(y) * kForeignWidth + static_cast<std::size_t>(x)] = value;
  }
  [[nodiscard]] Picture picture() const { return {colour, kForeignWidth}; }
};

TEST(ForeignPixels, CountsColoursThatTheReferenceDoesNotHaveNearby) {
  ForeignFilm shown;
  const ForeignFilm reference;
  shown.set(0, 0, kForeignSoil);
  shown.set(20, 15, kForeignSoil);
  shown.set(kForeignWidth - 1, kForeignHeight - 1, kForeignSoil);
  EXPECT_EQ(foreignPixels(shown.picture(), reference.picture()), 3u);
}

TEST(ForeignPixels, WhatMovedALittleIsNone) {
  ForeignFilm shown;
  ForeignFilm reference;
  shown.set(20, 15, kForeignSoil);
  reference.set(20 - kForeignReach, 15 + kForeignReach, kForeignSoil);
  EXPECT_EQ(foreignPixels(shown.picture(), reference.picture()), 0u);
  reference.set(20 - kForeignReach, 15 + kForeignReach, kForeignGrass);
  reference.set(20, 16 + kForeignReach, kForeignSoil);
  EXPECT_EQ(foreignPixels(shown.picture(), reference.picture()), 1u) << "too far away";
}

TEST(ForeignPixels, MixturesAndLikeColoursAreNone) {
  ForeignFilm shown;
  ForeignFilm reference;
  shown.set(5, 5, kForeignLikeGrass);
  EXPECT_EQ(foreignPixels(shown.picture(), reference.picture()), 0u);
  shown.set(20, 15, kForeignBetween);
  EXPECT_EQ(foreignPixels(shown.picture(), reference.picture()), 1u);
  reference.set(22, 15, kForeignSoil);
  EXPECT_EQ(foreignPixels(shown.picture(), reference.picture()), 0u);
}

}  // namespace
}  // namespace grove::measure
