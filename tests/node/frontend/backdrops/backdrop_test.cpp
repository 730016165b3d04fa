#include "node/frontend/backdrops/backdrop.h"

#include <gtest/gtest.h>

#include <cmath>

#include "each_target.h"
#include "node/frontend/backdrops/drawn_backdrop.h"
#include "node/frontend/backdrops/warp_camera.h"
#include "node/frontend/backdrops/warp_error.h"

namespace grove::node {
namespace {

using testing::backdropOf;
using testing::Pixel;

const world::Camera kCamera = testing::cameraOf(640, 360);
constexpr world::Rect kWhole{0, 0, 640, 360};

world::Camera movedBy(world::Vec3 way) {
  world::Camera camera = kCamera;
  camera.pose.position += way;
  return camera;
}

Pixel plainWall(const world::Camera&, world::Vec3) { return {0xFFFFFFFFU, 5.0F}; }

/// Every other column is at another depth.
std::shared_ptr<const Backdrop> fence(float near, float far) {
  const auto image = testing::paint(plainWall, kCamera, kWhole);
  for (std::size_t i = 0; i < image->depth.size(); ++i) image->depth[i] = i % 2 == 0 ? near : far;
  return backdropOf(image, testing::viewOf(kCamera));
}

TEST(Backdrop, AWallIsWarpedWithoutError) {
  const auto backdrop = backdropOf(plainWall, kCamera, kWhole);
  EXPECT_NEAR(backdrop->errorOf(WarpCamera(kCamera, movedBy({0.5F, 0.2F, 0.1F}))).shift, 0.0F, 0.05F);
  EXPECT_FLOAT_EQ(backdrop->nearest(), 0.2F);
}

TEST(Backdrop, TheErrorIsTheShiftOfWhatIsBehindAgainstWhatIsInFront) {
  tests::onEachTarget([] {
    const auto backdrop = fence(2.0F, 10.0F);
    constexpr float kStep = 0.1F;
    const float error = backdrop->errorOf(WarpCamera(kCamera, movedBy({kStep, 0.0F, 0.0F}))).shift;
    // Half of the pixels are shifted by f (1/2 - 1/10) too much.
    const float wanted = kCamera.focal() * kStep * 0.4F * std::sqrt(0.5F);
    EXPECT_NEAR(error, wanted, 0.01F * wanted);
  });
}

TEST(Backdrop, TheSkyHasNoError) {
  const auto image = testing::paint(plainWall, kCamera, kWhole);
  for (float& depth : image->depth) depth = world::kInfiniteDepth;
  const auto backdrop = backdropOf(image, testing::viewOf(kCamera));
  EXPECT_EQ(backdrop->errorOf(WarpCamera(kCamera, movedBy({1.0F, 0.0F, 0.0F}))).shift, 0.0F);
  EXPECT_EQ(backdrop->nearest(), 0.0F);
}

/// Fails if a few pixels right before the eye, whose errors have no limit, make every backdrop useless.
TEST(Backdrop, ALeafBeforeTheEyeDoesNotDecideForTheWholePicture) {
  const auto image = testing::paint(plainWall, kCamera, kWhole);
  for (int y = 64; y < 128; ++y) {
    for (int x = 64; x < 128; x += 2) image->depthRow(y)[x] = 0.1F;
  }
  const auto backdrop = backdropOf(image, testing::viewOf(kCamera));
  const Backdrop::Error error = backdrop->errorOf(WarpCamera(kCamera, movedBy({0.05F, 0.0F, -0.05F})));
  EXPECT_GT(error.shift, 1.0F) << "its block and those around it are wrong";
  EXPECT_LT(error.shift, 8.0F);
  EXPECT_LT(error.zoom, 0.3F);
}

TEST(WarpError, GrowsWithTheStepAndWithWhatComesNearer) {
  const auto backdrop = fence(2.0F, 10.0F);
  EXPECT_EQ(warpError(*backdrop, kCamera), 0.0F);
  EXPECT_LT(warpError(*backdrop, movedBy({0.005F, 0.0F, 0.0F})), 1.0F);
  EXPECT_GT(warpError(*backdrop, movedBy({0.05F, 0.0F, 0.0F})), 1.0F);
  const auto wall = backdropOf(plainWall, kCamera, kWhole);
  EXPECT_LT(warpError(*wall, movedBy({0.0F, 0.0F, -0.25F})), 1.0F);
  EXPECT_GT(warpError(*wall, movedBy({0.0F, 0.0F, -0.5F})), 1.0F) << "its pixels are too large";
}

TEST(LightError, IsAShareOfTheLight) {
  View before;
  before.lights = {{{}, {4.0F, 2.0F, 1.0F}}, {{}, {0.0F, 0.0F, 0.0F}}};
  View now = before;
  EXPECT_EQ(lightError(before, now), 0.0F);
  now.lights[0].colour *= 1.2F;
  EXPECT_LT(lightError(before, now), 1.0F);
  now.lights[0].colour *= 1.2F;
  EXPECT_GT(lightError(before, now), 1.0F);
  now = before;
  now.lights.pop_back();
  EXPECT_GT(lightError(before, now), 1.0F) << "a lantern has gone";
}

}  // namespace
}  // namespace grove::node
