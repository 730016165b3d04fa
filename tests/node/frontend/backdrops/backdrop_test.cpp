#include "node/frontend/backdrops/backdrop.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "each_target.h"
#include "node/frontend/backdrops/backdrop_area.h"
#include "node/frontend/backdrops/drawn_backdrop.h"
#include "node/frontend/backdrops/light_error.h"
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

std::shared_ptr<const Backdrop> drawn(const std::shared_ptr<const raster::Image>& image,
                                      const std::vector<world::PointLight>& lights = {}) {
  View view = testing::viewOf(kCamera);
  view.lights = lights;
  return backdropOf(image, {std::make_shared<const View>(std::move(view)), 1});
}

/// Every other column is at another depth.
std::shared_ptr<const Backdrop> fence(float near, float far) {
  const auto image = testing::paint(plainWall, kCamera, kWhole);
  for (std::size_t i = 0; i < image->depth.size(); ++i) image->depth[i] = i % 2 == 0 ? near : far;
  return drawn(image);
}

TEST(Backdrop, WallHasNoError) {
  const auto backdrop = backdropOf(plainWall, kCamera, kWhole);
  EXPECT_NEAR(backdrop->errorOf(WarpCamera(kCamera, movedBy({0.5F, 0.2F, 0.1F}))).shift, 0.0F, 0.05F);
  EXPECT_FLOAT_EQ(backdrop->nearest(), 0.2F);
}

TEST(Backdrop, ErrorIsTheParallaxBetweenFrontAndBack) {
  tests::onEachTarget([] {
    const auto backdrop = fence(2.0F, 10.0F);
    constexpr float kStep = 0.1F;
    const float error = backdrop->errorOf(WarpCamera(kCamera, movedBy({kStep, 0.0F, 0.0F}))).shift;
    // Half of the pixels are shifted by f (1/2 - 1/10) too much.
    const float wanted = kCamera.focal() * kStep * 0.4F * std::sqrt(0.5F);
    EXPECT_NEAR(error, wanted, 0.01F * wanted);
  });
}

TEST(Backdrop, SkyHasNoError) {
  const auto image = testing::paint(plainWall, kCamera, kWhole);
  for (float& depth : image->depth) depth = world::kInfiniteDepth;
  const auto backdrop = drawn(image);
  EXPECT_EQ(backdrop->errorOf(WarpCamera(kCamera, movedBy({1.0F, 0.0F, 0.0F}))).shift, 0.0F);
  EXPECT_EQ(backdrop->nearest(), 0.0F);
}

/// Fails if a few pixels right before the eye, whose errors have no limit, make every backdrop useless.
TEST(Backdrop, OneNearLeafDoesNotDecideTheError) {
  const auto image = testing::paint(plainWall, kCamera, kWhole);
  for (int y = 64; y < 128; ++y) {
    for (int x = 64; x < 128; x += 2) image->depthRow(y)[x] = 0.1F;
  }
  const auto backdrop = drawn(image);
  const Backdrop::Error error = backdrop->errorOf(WarpCamera(kCamera, movedBy({0.05F, 0.0F, -0.05F})));
  EXPECT_GT(error.shift, 1.0F) << "its block and those around it are wrong";
  EXPECT_LT(error.shift, 8.0F);
  EXPECT_LT(error.zoom, 0.3F);
}

TEST(WarpError, GrowsWithStepAndNearness) {
  const auto backdrop = fence(2.0F, 10.0F);
  EXPECT_EQ(warpError(*backdrop, kCamera), 0.0F);
  EXPECT_LT(warpError(*backdrop, movedBy({0.005F, 0.0F, 0.0F})), 1.0F);
  EXPECT_GT(warpError(*backdrop, movedBy({0.05F, 0.0F, 0.0F})), 1.0F);
  const auto wall = backdropOf(plainWall, kCamera, kWhole);
  EXPECT_LT(warpError(*wall, movedBy({0.0F, 0.0F, -0.25F})), 1.0F);
  EXPECT_GT(warpError(*wall, movedBy({0.0F, 0.0F, -0.5F})), 1.0F) << "its pixels are too large";
}

/// Fails if cells or pixels of another part are taken, or land elsewhere.
TEST(BackdropDepths, CopiedAndMeasuredPartsEqualTheWhole) {
  const auto slope = [](const world::Camera&, world::Vec3 ray) { return Pixel{0, 6.0F + 2.0F * ray.x + ray.y}; };
  const world::Rect area{-8, -16, 72, 48};
  const world::Rect kept{0, -8, 48, 48};
  const auto measured = [&](BackdropDepths& depths, const world::Rect& part) {
    depths.measure(*testing::paint(slope, kCamera, part));
  };
  raster::ImagePool pool;
  BackdropDepths whole(area, pool);
  measured(whole, area);
  BackdropDepths before({-24, -8, 48, 56}, pool);
  measured(before, {-24, -8, 48, 56});
  BackdropDepths extended(area, pool);
  extended.copy(before, kept);
  for (const world::Rect& part : partsBeyond(area, kept)) measured(extended, part);
  EXPECT_TRUE(std::ranges::equal(extended.nearness(), whole.nearness()));
  ASSERT_EQ(extended.cells().size(), whole.cells().size());
  for (std::size_t i = 0; i < whole.cells().size(); ++i) {
    EXPECT_EQ(extended.cells()[i].count, whole.cells()[i].count) << i;
    EXPECT_FLOAT_EQ(extended.cells()[i].nearness, whole.cells()[i].nearness) << i;
    EXPECT_FLOAT_EQ(extended.cells()[i].nearest, whole.cells()[i].nearest) << i;
  }
}

/// A lamp so far away that a wall of 5 metres is lit evenly.
world::PointLight farLamp(float radiance) { return {{0.0F, 0.0F, 1000.0F}, world::Vec3(radiance * 1005.0F * 1005.0F)}; }

TEST(LightError, IsTheChangeOnVisibleSurfaces) {
  const auto image = testing::paint(plainWall, kCamera, kWhole);
  const auto wall = drawn(image, {farLamp(0.1F)});
  EXPECT_EQ(lightError(*wall, {farLamp(0.1F)}), 0.0F);
  const float error = lightError(*wall, {farLamp(0.14F)});
  EXPECT_NEAR(error, 1.0F, 0.05F) << "0.04 of radiance is what is permitted";
  EXPECT_NEAR(lightError(*wall, {farLamp(0.06F)}), error, 0.05F);
  EXPECT_NEAR(lightError(*wall, {}), 2.5F * error, 0.1F) << "it has gone";
  EXPECT_NEAR(lightError(*wall, {farLamp(0.1F), farLamp(0.04F)}), error, 0.05F) << "another has come";
  std::vector<world::PointLight> turned{farLamp(0.1F)};
  turned.front().position.z = -1000.0F;
  EXPECT_LT(lightError(*wall, turned), 0.1F) << "it lights the wall as before";
}

/// Fails if a fire on the other side of the world, or the sky before it, has a visitor's scenery drawn anew.
TEST(LightError, CountsOnlyLitSurfaces) {
  const auto image = testing::paint(plainWall, kCamera, kWhole);
  const world::PointLight fire{{0.0F, 1.0F, -4.0F}, {2.6F, 1.0F, 0.3F}};
  world::PointLight far = fire;
  far.position.z = 60.0F;
  EXPECT_GT(lightError(*drawn(image), {fire}), 1.0F);
  EXPECT_LT(lightError(*drawn(image), {far}), 0.05F);
  for (float& depth : image->depth) depth = world::kInfiniteDepth;
  EXPECT_EQ(lightError(*drawn(image), {fire}), 0.0F);
}

}  // namespace
}  // namespace grove::node
