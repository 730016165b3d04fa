#include "objects/lightfield/common/layered_haze.h"

#include <gtest/gtest.h>

#include "objects/lightfield/common/object_view.h"
#include "world/light.h"

namespace grove::objects::lightfield {
namespace {

/// A camera at a visitor's height that looks north, at objects on its axis.
world::Camera camera() {
  world::Camera camera;
  camera.width = 640;
  camera.height = 360;
  camera.pose.position = {0.0F, 1.7F, 0.0F};
  return camera;
}

world::Bounds treesAt(float distance) { return {world::Vec3(-5, 0, -distance - 5), world::Vec3(5, 15, -distance + 5)}; }

/// The row in which the camera sees this height at this distance.
int rowOf(float height, float distance) {
  int row = 0;
  while (camera().ray(320.0F, static_cast<float>(row) + 0.5F).y * distance + 1.7F > height) ++row;
  return row;
}

// Fault: a distant tree's foot is dark where the ground beneath it is in mist.
TEST(LayeredHaze, TheFootHasTheMistOfTheGround) {
  constexpr float kDistance = 100.0F;
  const LayeredHaze haze(treesAt(kDistance), {}, camera());
  const float air = hazeBefore(treesAt(kDistance), {}, camera()).amount;
  const float expected = 1.0F - (1.0F - air) * (1.0F - world::mistAmount(kDistance));
  EXPECT_NEAR(haze.at(rowOf(0.0F, kDistance), 1).first.amount, expected, 0.01F);
  EXPECT_GT(expected, air + 0.2F);
}

// Fault: mist covers crowns, or a near tree.
TEST(LayeredHaze, CrownsAndNearTreesAreAboveIt) {
  const LayeredHaze far(treesAt(100.0F), {}, camera());
  EXPECT_FLOAT_EQ(far.at(rowOf(world::kMistTop + 1.0F, 100.0F), 1).first.amount,
                  hazeBefore(treesAt(100.0F), {}, camera()).amount);
  const LayeredHaze near(treesAt(20.0F), {}, camera());
  EXPECT_FLOAT_EQ(near.at(rowOf(0.0F, 20.0F), 1).first.amount, hazeBefore(treesAt(20.0F), {}, camera()).amount);
  EXPECT_EQ(near.at(200, 8).perRow, 0.0F);
}

// Fault: a line shows between two tiles.
TEST(LayeredHaze, TilesContinueEachOther) {
  const LayeredHaze haze(treesAt(60.0F), {}, camera());
  for (int row = 0; row < 360; row += 8) {
    const TileHaze tile = haze.at(row, 8);
    EXPECT_NEAR(tile.first.amount + 8.0F * tile.perRow, haze.at(row + 8, 8).first.amount, 1e-5F);
  }
}

// Fault: a picture that is drawn for one frame has no mist, or mist where the object covers nothing.
TEST(LayeredHaze, FinishedPicturesGetTheSameMist) {
  constexpr float kDistance = 100.0F;
  const LayeredHaze haze(treesAt(kDistance), {}, camera());
  const Haze air = hazeBefore(treesAt(kDistance), {}, camera());
  raster::ImagePool images;
  const int top = rowOf(12.0F, kDistance);
  const auto picture = images.acquire({10, top, 12, rowOf(0.0F, kDistance) + 1});
  for (int row = 0; row < picture->height(); ++row) {
    picture->colourRow(row)[0] = 0xFF204060U;
    picture->colourRow(row)[1] = 0U;
  }
  haze.addMistTo(*picture);
  for (int row = 0; row < picture->height(); ++row) {
    const float clear = (1.0F - haze.at(top + row, 1).first.amount) / (1.0F - air.amount);
    const float red = 96.0F * clear + 255.0F * air.colour[0] * (1.0F - clear);
    EXPECT_NEAR(static_cast<float>(picture->colourRow(row)[0] & 255U), red, 1.0F) << row;
    EXPECT_EQ(picture->colourRow(row)[1], 0U);
  }
}

TEST(LayeredHaze, IsTheSameEverywhereIfNoMistIsGiven) {
  const LayeredHaze haze(Haze{{0.1F, 0.2F, 0.3F}, 0.4F});
  EXPECT_EQ(haze.at(7, 8).first.amount, 0.4F);
  EXPECT_EQ(haze.at(7, 8).perRow, 0.0F);
}

}  // namespace
}  // namespace grove::objects::lightfield
