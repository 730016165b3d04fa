#include "objects/lightfield/backend/surroundings/shadows.h"

#include <algorithm>
#include <vector>

#include "objects/lightfield/common/grey_wall.h"

namespace grove::objects::lightfield {
namespace {

using Shadows = GreyWall;

/// The sun reaches what is right of x = 0.
SunGrid halfShaded() {
  SunGrid grid;
  grid.cells = {3, 2, 2};
  grid.low = {-1.0F, -5.0F, -6.0F};
  grid.perMetre = {1.0F, 0.1F, 0.5F};
  grid.sun = {0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1};
  grid.whole = false;
  return grid;
}

TEST_F(Shadows, FullSunChangesNothing) {
  const std::vector<std::uint32_t> before(image_->colour.begin(), image_->colour.end());
  SunGrid whole;
  whole.sun = {1.0F};
  castShadows(whole, camera_, *image_);
  EXPECT_TRUE(std::ranges::equal(before, image_->colour));
}

TEST_F(Shadows, ShadeIsDarkerAndBluer) {
  castShadows(halfShaded(), camera_, *image_);
  for (int y = 0; y < image_->height(); ++y) {
    const std::uint32_t shaded = image_->colourRow(y)[2];
    EXPECT_LT(red(shaded), 80);
    EXPECT_GT(blue(shaded), red(shaded));
    EXPECT_EQ(image_->colourRow(y)[30], kGrey);
    // Between the samples the shade fades.
    EXPECT_GT(red(image_->colourRow(y)[18]), red(shaded));
    EXPECT_LT(red(image_->colourRow(y)[18]), red(kGrey));
    EXPECT_EQ(image_->colourRow(y)[32], 0U);
  }
}

}  // namespace
}  // namespace grove::objects::lightfield
