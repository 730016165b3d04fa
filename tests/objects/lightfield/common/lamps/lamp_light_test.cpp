#include "objects/lightfield/common/lamps/lamp_light.h"

#include <algorithm>
#include <vector>

#include "objects/lightfield/common/grey_wall.h"

namespace grove::objects::lightfield {
namespace {

using Lamps = GreyWall;

TEST_F(Lamps, NoLampChangesNothing) {
  const std::vector<std::uint32_t> before(image_->colour.begin(), image_->colour.end());
  LampLight({}, camera_).addTo(*image_);
  EXPECT_TRUE(std::ranges::equal(before, image_->colour));
}

TEST_F(Lamps, BrightestNearTheLamp) {
  const std::vector<world::PointLight> lamps{{{-3.0F, 0.0F, -4.0F}, {1.0F, 0.5F, 0.1F}}};
  LampLight(lamps, camera_).addTo(*image_);
  const std::uint32_t* row = image_->colourRow(16);
  EXPECT_GT(red(row[6]), 160);
  EXPECT_LT(red(row[31]), red(row[6]));
  EXPECT_GE(red(row[31]), red(kGrey));
  EXPECT_GT(red(row[6]), blue(row[6]));
  EXPECT_EQ(row[32], 0U);
}

TEST_F(Lamps, PartsEqualTheWhole) {
  for (int y = 0; y < image_->height(); ++y) {
    for (int x = 0; x < 32; ++x) image_->depthRow(y)[x] = 2.0F + 0.5F * static_cast<float>(x);
  }
  // Some parts are reached by both, some by one, some by none.
  const std::vector<world::PointLight> lamps{{{-3.0F, 0.0F, -4.0F}, {1.0F, 0.5F, 0.1F}},
                                             {{9.0F, 6.0F, -11.0F}, {0.3F, 0.9F, 1.1F}}};
  const LampLight light(lamps, camera_);
  const auto parts = pool_.acquire(image_->rect);
  std::ranges::copy(image_->colour, parts->colour.begin());
  light.addTo(*image_);
  int unlit = 0;
  for (int top = 0; top < 32; top += 8) {
    for (int left = 0; left < 33; left += 8) {
      const world::Rect part{left, top, std::min(left + 8, 33), top + 8};
      std::uint32_t* colour = parts->colourRow(top) + left;
      light.addTo(part, colour, image_->depthRow(top) + left, parts->width());
      unlit += *colour == kGrey ? 1 : 0;
    }
  }
  EXPECT_GT(unlit, 0);
  for (std::size_t i = 0; i < parts->colour.size(); ++i) {
    for (const unsigned shift : {0U, 8U, 16U, 24U}) {
      EXPECT_NEAR(parts->colour[i] >> shift & 255U, image_->colour[i] >> shift & 255U, 1);
    }
  }
}

TEST_F(Lamps, ColourNeverExceedsCoverage) {
  std::fill(image_->colour.begin(), image_->colour.end(), 0x40404040U);
  const std::vector<world::PointLight> lamps{{{0.0F, 0.0F, -5.0F}, {50.0F, 50.0F, 50.0F}}};
  LampLight(lamps, camera_).addTo(*image_);
  for (const std::uint32_t pixel : image_->colour) {
    EXPECT_EQ(pixel >> 24U, 0x40U);
    EXPECT_LE(red(pixel), 0x40);
  }
}

}  // namespace
}  // namespace grove::objects::lightfield
