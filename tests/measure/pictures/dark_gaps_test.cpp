#include "measure/pictures/dark_gaps.h"

#include <gtest/gtest.h>

#include <cstdint>

#include "measure/grass_film.h"

namespace grove::measure {
namespace {

using tests::GrassFilm;

constexpr std::uint32_t kGapBlack = 0xFF050505U;
constexpr std::uint32_t kGapShade = 0xFF0E0E0EU;  // above kNearBlack, within kDarkGapContrast of it

TEST(DarkGaps, CountsPixelsWithoutADarkReferenceNearby) {
  GrassFilm shown;
  const GrassFilm reference;
  shown.set(0, 0, kGapBlack);
  shown.set(20, 15, kGapBlack);
  shown.set(GrassFilm::kWidth - 1, GrassFilm::kHeight - 1, kGapBlack);
  EXPECT_EQ(darkGaps(shown.picture(), reference.picture()), 3u);
}

TEST(DarkGaps, ToleratesSmallMotion) {
  GrassFilm shown;
  GrassFilm reference;
  shown.set(20, 15, kGapBlack);
  reference.set(20 + kDarkGapReach, 15 - kDarkGapReach, kGapBlack);
  EXPECT_EQ(darkGaps(shown.picture(), reference.picture()), 0u);
  reference.set(20 + kDarkGapReach, 15 - kDarkGapReach, GrassFilm::kGrass);
  reference.set(21 + kDarkGapReach, 15, kGapBlack);
  EXPECT_EQ(darkGaps(shown.picture(), reference.picture()), 1u) << "too far away";
}

TEST(DarkGaps, ToleratesSlightlyDarkerShade) {
  GrassFilm shown;
  GrassFilm reference;
  shown.set(20, 15, kGapBlack);
  reference.set(20, 15, kGapShade);
  EXPECT_EQ(darkGaps(shown.picture(), reference.picture()), 0u);
  EXPECT_EQ(darkGaps(reference.picture(), shown.picture()), 0u) << "not near-black";
}

}  // namespace
}  // namespace grove::measure
