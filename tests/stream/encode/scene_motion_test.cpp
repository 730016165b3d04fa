#include "stream/encode/scene_motion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

namespace grove::stream {
namespace {

constexpr int kCell = node::CellNearness::kCell;

world::Camera cameraOf(int width = 640, int height = 360) {
  world::Camera camera;
  camera.width = width;
  camera.height = height;
  return camera;
}

/// 1 / depth of what a ray of one metre of view depth meets; 0: nothing.
using NearnessOf = std::function<float(const world::Camera& camera, world::Vec3 ray)>;

float centreOf(int cell) { return static_cast<float>(cell * kCell) + 0.5F * kCell; }

std::shared_ptr<const node::CellNearness> look(const world::Camera& camera, const NearnessOf& nearness) {
  raster::ImagePool pool;
  auto cells = std::make_shared<node::CellNearness>(camera.width, camera.height, pool);
  for (int row = 0; row < cells->down(); ++row) {
    for (int column = 0; column < cells->across(); ++column) {
      cells->row(row)[static_cast<std::size_t>(column)] = nearness(camera, camera.ray(centreOf(column), centreOf(row)));
    }
  }
  return cells;
}

/// A wall at z = -5, parallel to the picture of a camera that looks along -z.
float wallAt(const world::Camera& camera, world::Vec3 ray) { return ray.z / (-5.0F - camera.pose.position.z); }
/// The ground at y = 0, and the sky.
float groundAt(const world::Camera& camera, world::Vec3 ray) { return std::max(ray.y / -camera.pose.position.y, 0.0F); }
float skyAt(const world::Camera&, world::Vec3) { return 0.0F; }

/// Fails unless each vector leads to where `shown` saw the content of the cell's centre, to half a quarter of a pixel.
void expectMotion(const world::Camera& shown, const world::Camera& frame, const NearnessOf& nearness) {
  const auto cells = look(frame, nearness);
  SceneMotion motion;
  EXPECT_TRUE(motion.next(shown, cells.get()).empty()) << "nothing is known of the first";
  const auto vectors = motion.next(frame, cells.get());
  ASSERT_EQ(vectors.size(), cells->cells().size());
  for (int row = 0; row < cells->down(); ++row) {
    for (int column = 0; column < cells->across(); ++column) {
      const float near = cells->row(row)[static_cast<std::size_t>(column)];
      const world::Vec3 ray = frame.ray(centreOf(column), centreOf(row));
      // What is infinitely far does not move with the camera.
      const world::Vec3 point = near > 0.0F ? frame.pose.position + ray / near : shown.pose.position + ray;
      const world::Vec3 place = shown.project(point);
      const auto at =
          static_cast<std::size_t>(row) * static_cast<std::size_t>(cells->across()) + static_cast<std::size_t>(column);
      constexpr float kHalf = 0.51F;  // and what floats are wrong by
      ASSERT_NEAR(vectors[at].x, 4.0F * (place.x - centreOf(column)), kHalf) << column << ", " << row;
      ASSERT_NEAR(vectors[at].y, 4.0F * (place.y - centreOf(row)), kHalf) << column << ", " << row;
    }
  }
}

// Fault: a vector of the wrong sign or size. Five metres away, 0.1 m is a fiftieth of the focal length.
TEST(SceneMotion, StepToTheSideMovesAWallAsAWhole) {
  const world::Camera shown = cameraOf();
  world::Camera frame = shown;
  frame.pose.position.x += 0.1F;
  const auto cells = look(frame, wallAt);
  SceneMotion motion;
  (void)motion.next(shown, cells.get());
  const auto quarters = static_cast<std::int16_t>(std::lround(4.0F * frame.focal() * 0.1F / 5.0F));
  for (const MotionVector& each : motion.next(frame, cells.get())) ASSERT_EQ(each, (MotionVector{quarters, 0}));
  expectMotion(shown, frame, wallAt);
}

TEST(SceneMotion, FollowsPerspective) {
  const world::Camera shown = cameraOf();
  for (const NearnessOf& scene : {NearnessOf(wallAt), NearnessOf(groundAt), NearnessOf(skyAt)}) {
    world::Camera turned = shown;
    turned.pose.yaw += 0.08F;
    turned.pose.pitch -= 0.05F;
    expectMotion(shown, turned, scene);
    world::Camera ahead = shown;
    ahead.pose.position.z -= 0.15F;
    expectMotion(shown, ahead, scene);
    world::Camera both = turned;
    both.pose.position += world::Vec3(0.1F, -0.2F, 0.3F);
    expectMotion(shown, both, scene);
    expectMotion(shown, shown, scene);
    both.verticalFov *= 1.1F;  // another border
    expectMotion(shown, both, scene);
  }
}

// Fault: a last cell that is missing, or has the motion of another place.
TEST(SceneMotion, HasCellsBeyondTheEdge) {
  const world::Camera shown = cameraOf(650, 364);
  world::Camera frame = shown;
  frame.pose.yaw -= 0.05F;
  frame.pose.position += world::Vec3(0.2F, 0.0F, -0.3F);
  ASSERT_EQ(look(frame, groundAt)->across(), 82);
  ASSERT_EQ(look(frame, groundAt)->down(), 46);
  expectMotion(shown, frame, groundAt);
}

// Faults: a number that overflows; a mirrored place of what was behind the camera.
TEST(SceneMotion, LimitsVectors) {
  const world::Camera shown = cameraOf();
  world::Camera frame = shown;
  frame.pose.yaw += 1.2F;
  const auto cells = look(frame, skyAt);
  const auto motionTo = [&](float yaw) {
    SceneMotion motion;
    world::Camera other = shown;
    other.pose.yaw = yaw;
    (void)motion.next(other, cells.get());
    const auto vectors = motion.next(frame, cells.get());
    return std::vector<MotionVector>(vectors.begin(), vectors.end());
  };
  const auto far = motionTo(0.0F);
  EXPECT_EQ(std::ranges::min(far, {}, &MotionVector::x).x, -kMaxMotion);
  for (const MotionVector& each : motionTo(1.2F + 3.0F)) ASSERT_EQ(each, MotionVector{});
}

// Fault: vectors between pictures whose pixels do not correspond, or from no nearness.
TEST(SceneMotion, IsUnknownAfterAChangeOfSize) {
  const world::Camera large = cameraOf();
  const world::Camera small = cameraOf(480, 270);
  const auto cells = look(large, groundAt);
  const auto smallCells = look(small, groundAt);
  SceneMotion motion;
  (void)motion.next(large, cells.get());
  EXPECT_FALSE(motion.next(large, cells.get()).empty());
  EXPECT_TRUE(motion.next(small, smallCells.get()).empty());
  EXPECT_EQ(motion.next(small, smallCells.get()).size(), smallCells->cells().size());
  EXPECT_TRUE(motion.next(small, nullptr).empty());
  EXPECT_FALSE(motion.next(small, smallCells.get()).empty()) << "its camera is known all the same";
}

}  // namespace
}  // namespace grove::stream
