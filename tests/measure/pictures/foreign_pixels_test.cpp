#include "measure/pictures/foreign_pixels.h"

#include <gtest/gtest.h>

#include <cstdint>

#include "measure/grass_film.h"

namespace grove::measure {
namespace {

using tests::GrassFilm;

constexpr std::uint32_t kForeignSoil = 0xFF205890U;
constexpr std::uint32_t kForeignLikeGrass = 0xFF206060U;  // kForeignContrast redder
constexpr std::uint32_t kForeignBetween = 0xFF205C68U;

TEST(ForeignPixels, CountsColoursAbsentFromTheReference) {
  GrassFilm shown;
  const GrassFilm reference;
  shown.set(0, 0, kForeignSoil);
  shown.set(20, 15, kForeignSoil);
  shown.set(GrassFilm::kWidth - 1, GrassFilm::kHeight - 1, kForeignSoil);
  EXPECT_EQ(foreignPixels(shown.picture(), reference.picture()), 3u);
}

TEST(ForeignPixels, ToleratesSmallMotion) {
  GrassFilm shown;
  GrassFilm reference;
  shown.set(20, 15, kForeignSoil);
  reference.set(20 - kForeignReach, 15 + kForeignReach, kForeignSoil);
  EXPECT_EQ(foreignPixels(shown.picture(), reference.picture()), 0u);
  reference.set(20 - kForeignReach, 15 + kForeignReach, GrassFilm::kGrass);
  reference.set(20, 16 + kForeignReach, kForeignSoil);
  EXPECT_EQ(foreignPixels(shown.picture(), reference.picture()), 1u) << "too far away";
}

TEST(ForeignPixels, ToleratesMixturesAndSimilarColours) {
  GrassFilm shown;
  GrassFilm reference;
  shown.set(5, 5, kForeignLikeGrass);
  EXPECT_EQ(foreignPixels(shown.picture(), reference.picture()), 0u);
  shown.set(20, 15, kForeignBetween);
  EXPECT_EQ(foreignPixels(shown.picture(), reference.picture()), 1u);
  reference.set(22, 15, kForeignSoil);
  EXPECT_EQ(foreignPixels(shown.picture(), reference.picture()), 0u);
}

}  // namespace
}  // namespace grove::measure
