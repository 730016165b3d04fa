#include "objects/lightfield/relight.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace grove::objects::lightfield {
namespace {

using world::Vec3;

constexpr std::uint32_t kGrey = 0xFF808080U;

/// A picture of a grey wall that stands 5 m before the eye; its last column shows nothing.
class Relight : public testing::Test {
 protected:
  Relight() {
    camera_.corner = {-1.0F, 1.0F, -1.0F};
    camera_.perColumn = {2.0F / 33.0F, 0.0F, 0.0F};
    camera_.perRow = {0.0F, -2.0F / 32.0F, 0.0F};
    std::fill(image_->colour.begin(), image_->colour.end(), kGrey);
    std::fill(image_->depth.begin(), image_->depth.end(), 5.0F);
    for (int y = 0; y < image_->height(); ++y) {
      image_->colourRow(y)[32] = 0;
      image_->depthRow(y)[32] = world::kInfiniteDepth;
    }
    whole_.sun = {1.0F};
  }

  /// The sun reaches what is right of x = 0.
  static SunGrid halfShaded() {
    SunGrid grid;
    grid.cells = {3, 2, 2};
    grid.low = {-1.0F, -5.0F, -6.0F};
    grid.perMetre = {1.0F, 0.1F, 0.5F};
    grid.sun = {0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1};
    grid.whole = false;
    return grid;
  }

  static int red(std::uint32_t pixel) { return static_cast<int>(pixel & 0xFFU); }
  static int blue(std::uint32_t pixel) { return static_cast<int>(pixel >> 16U & 0xFFU); }

  raster::ImagePool pool_;
  std::shared_ptr<raster::Image> image_ = pool_.acquire({0, 0, 33, 32});
  ObjectCamera camera_;
  SunGrid whole_;
};

TEST_F(Relight, AllOfTheSunAndNoLampChangeNothing) {
  const std::vector<std::uint32_t> before(image_->colour.begin(), image_->colour.end());
  castShadows(whole_, camera_, *image_);
  LampLight({}, camera_).addTo(*image_);
  EXPECT_TRUE(std::ranges::equal(before, image_->colour));
}

TEST_F(Relight, ShadeIsDarkerAndBluer) {
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

TEST_F(Relight, ALampIsBrightestWhereItIsNear) {
  const std::vector<world::PointLight> lamps{{{-3.0F, 0.0F, -4.0F}, {1.0F, 0.5F, 0.1F}}};
  LampLight(lamps, camera_).addTo(*image_);
  const std::uint32_t* row = image_->colourRow(16);
  EXPECT_GT(red(row[6]), 160);
  EXPECT_LT(red(row[31]), red(row[6]));
  EXPECT_GE(red(row[31]), red(kGrey));
  EXPECT_GT(red(row[6]), blue(row[6]));
  EXPECT_EQ(row[32], 0U);
}

TEST_F(Relight, PartsAreLitAsTheWhole) {
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

TEST_F(Relight, ColourNeverExceedsCoverage) {
  std::fill(image_->colour.begin(), image_->colour.end(), 0x40404040U);
  const std::vector<world::PointLight> lamps{{{0.0F, 0.0F, -5.0F}, {50.0F, 50.0F, 50.0F}}};
  LampLight(lamps, camera_).addTo(*image_);
  for (const std::uint32_t pixel : image_->colour) {
    EXPECT_EQ(pixel >> 24U, 0x40U);
    EXPECT_LE(red(pixel), 0x40);
  }
}

TEST_F(Relight, TheNearestFewLampsAreChosenInObjectCoordinates) {
  const world::Bounds bounds{{9.0F, 0.0F, -1.0F}, {11.0F, 3.0F, 1.0F}};
  const world::Mat4 toObject = glm::translate(world::Mat4(1.0F), Vec3(-10.0F, 0.0F, 0.0F));
  std::vector<world::PointLight> lights;
  for (int i = 0; i < 8; ++i) lights.push_back({{static_cast<float>(i) * 2.0F, 1.0F, 0.0F}, Vec3(1.0F)});
  const auto chosen = chooseLamps(lights, bounds, toObject);
  ASSERT_EQ(chosen.size(), kMostLamps);
  EXPECT_EQ(chosen[0].position, Vec3(0.0F, 1.0F, 0.0F));
  EXPECT_TRUE(chooseLamps(std::vector<world::PointLight>{{{-40, 0, 0}, Vec3(1.0F)}}, bounds, toObject).empty());
}

}  // namespace
}  // namespace grove::objects::lightfield
