#include "objects/lightfield/frontend/near_margins.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "objects/lightfield/frontend/near_cameras.h"

namespace grove::objects::lightfield {
namespace {

using world::Rect;

constexpr Rect kWhole{0, 0, kPictureSize, kPictureSize};
const world::Vec3 kEye(0.0F);

world::Camera frameOf() {
  world::Camera frame;
  frame.width = kPictureSize;
  frame.height = kPictureSize;
  return frame;
}

/// The last picture, from an eye that looked straight ahead; its texels are `times` as wide as pixels.
NearView lastOf(int times) {
  ObjectCamera camera = turnedCamera(kEye);
  camera.perColumn *= static_cast<float>(times);
  camera.perRow *= static_cast<float>(times);
  const auto image = raster::ImagePool().acquire({0, 0, kPictureSize / times, kPictureSize / times});
  std::ranges::fill(image->colour, 0xFFFFFFFFU);
  std::ranges::fill(image->depth, 2.0F);
  return {.picture = std::make_shared<const CachedView>(*image, camera), .sampled = image->rect};
}

TEST(NearMargins, FirstPictureHasEqualMargins) {
  EXPECT_EQ(withMargins(kWhole, frameOf(), turnedCamera(kEye), {}, 1.0F),
            (Rect{-32, -24, kPictureSize + 32, kPictureSize + 24}));
}

/// Fails if a picture has texels where its object cannot be, or so few that it seems to go on there.
TEST(NearMargins, ContainedObjectGetsAVisibleEdge) {
  const Rect inside{10, 20, 60, 70};
  EXPECT_EQ(withMargins(inside, frameOf(), turnedCamera(kEye), {}, 1.0F), (Rect{1, 11, 69, 79}));
  EXPECT_EQ(withMargins(inside, frameOf(), turnedCamera(kEye), {}, 2.5F), (Rect{-13, -3, 83, 93}));
}

/// Fails if a head that goes on turning needs a new picture in every frame.
TEST(NearMargins, FollowTheLastTurn) {
  const float turn = 0.2F;
  const float edge = std::atan(0.5F * kPictureSize / kPictureFocal);
  const float beyond = kPictureFocal * (std::tan(edge + turn) - std::tan(edge));
  for (const int times : {1, 4}) {
    const Rect left = withMargins(kWhole, frameOf(), turnedCamera(kEye, turn), lastOf(times), 1.0F);
    EXPECT_NEAR(static_cast<float>(left.left), -2.0F * beyond, 1.0F);
    EXPECT_EQ(left.right, kPictureSize + 32);
    EXPECT_EQ(left.top, -24);
    const Rect right = withMargins(kWhole, frameOf(), turnedCamera(kEye, -turn), lastOf(times), 1.0F);
    EXPECT_NEAR(static_cast<float>(right.right), kPictureSize + 2.0F * beyond, 1.0F);
  }
}

TEST(NearMargins, AreBounded) {
  EXPECT_EQ(withMargins(kWhole, frameOf(), turnedCamera(kEye, 0.9F), lastOf(1), 1.0F).left, -256);
  EXPECT_EQ(withMargins(kWhole, frameOf(), turnedCamera(kEye, 3.0F), lastOf(1), 1.0F),
            (Rect{-32, -24, kPictureSize + 32, kPictureSize + 24}))
      << "it looks elsewhere";
}

}  // namespace
}  // namespace grove::objects::lightfield
