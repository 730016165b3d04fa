#include "measure/dark_gaps.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

namespace grove::measure {
namespace {

constexpr int kGapsWidth = 40;
constexpr int kGapsHeight = 30;
constexpr std::uint32_t kGapGrass = 0xFF206040U;
constexpr std::uint32_t kGapBlack = 0xFF050505U;
constexpr std::uint32_t kGapShade = 0xFF0E0E0EU;  // above kNearBlack, within kDarkGapContrast of it

struct DarkFilm {
  std::vector<std::uint32_t> colour = std::vector<std::uint32_t>(std::size_t{kGapsWidth} * kGapsHeight, kGapGrass);

  void set(int x, int y, std::uint32_t value) {
    colour[static_cast<std::size_t>(y) * kGapsWidth + static_cast<std::size_t>(x)] = value;
  }
  [[nodiscard]] Picture picture() const { return {colour, kGapsWidth}; }
};

TEST(DarkGaps, CountsWhatTheReferenceDoesNotHaveNearby) {
  DarkFilm shown;
  const DarkFilm reference;
  shown.set(0, 0, kGapBlack);
  shown.set(20, 15, kGapBlack);
  shown.set(kGapsWidth - 1, kGapsHeight - 1, kGapBlack);
  EXPECT_EQ(darkGaps(shown.picture(), reference.picture()), 3u);
}

TEST(DarkGaps, WhatMovedALittleIsNone) {
  DarkFilm shown;
  DarkFilm reference;
  shown.set(20, 15, kGapBlack);
  reference.set(20 + kDarkGapReach, 15 - kDarkGapReach, kGapBlack);
  EXPECT_EQ(darkGaps(shown.picture(), reference.picture()), 0u);
  reference.set(20 + kDarkGapReach, 15 - kDarkGapReach, kGapGrass);
  reference.set(21 + kDarkGapReach, 15, kGapBlack);
  EXPECT_EQ(darkGaps(shown.picture(), reference.picture()), 1u) << "too far away";
}

TEST(DarkGaps, ShadeThatIsALittleDarkerIsNone) {
  DarkFilm shown;
  DarkFilm reference;
  shown.set(20, 15, kGapBlack);
  reference.set(20, 15, kGapShade);
  EXPECT_EQ(darkGaps(shown.picture(), reference.picture()), 0u);
  EXPECT_EQ(darkGaps(reference.picture(), shown.picture()), 0u) << "not near-black";
}

}  // namespace
}  // namespace grove::measure
