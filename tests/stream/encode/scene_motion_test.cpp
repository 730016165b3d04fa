#include "stream/encode/scene_motion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <utility>
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

node::FinishedFrame frameOf(const world::Camera& camera, std::shared_ptr<const node::CellNearness> cells,
                            double time = 0.0, std::vector<node::Mover> movers = {}) {
  auto view = std::make_shared<node::View>();
  view->camera = camera;
  view->time = time;
  return {.view = std::move(view), .picture = nullptr, .nearness = std::move(cells), .movers = std::move(movers)};
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
  EXPECT_TRUE(motion.next(frameOf(shown, cells)).empty()) << "nothing is known of the first";
  const auto vectors = motion.next(frameOf(frame, cells));
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
  (void)motion.next(frameOf(shown, cells));
  const auto quarters = static_cast<std::int16_t>(std::lround(4.0F * frame.focal() * 0.1F / 5.0F));
  for (const MotionVector& each : motion.next(frameOf(frame, cells))) ASSERT_EQ(each, (MotionVector{quarters, 0}));
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
    (void)motion.next(frameOf(other, cells));
    const auto vectors = motion.next(frameOf(frame, cells));
    return std::vector<MotionVector>(vectors.begin(), vectors.end());
  };
  const auto far = motionTo(0.0F);
  EXPECT_EQ(std::ranges::min(far, {}, &MotionVector::x).x, -kMaxMotion);
  for (const MotionVector& each : motionTo(1.2F + 3.0F)) ASSERT_EQ(each, MotionVector{});
}

/// Somebody two metres before a camera at the origin, in the columns from `left` to `right`, before a wall.
std::shared_ptr<const node::CellNearness> walkerBeforeWall(int left, int right) {
  const world::Camera camera = cameraOf();
  raster::ImagePool pool;
  auto cells = std::make_shared<node::CellNearness>(camera.width, camera.height, pool);
  for (int row = 0; row < cells->down(); ++row) {
    const std::span<float> line = cells->row(row);
    std::ranges::fill(line, 0.2F);
    for (int column = left; column < right; ++column) line[static_cast<std::size_t>(column)] = 0.5F;
  }
  return cells;
}

// Faults: others' figures count as still; the wall beside them, or a tree before them, moves along.
TEST(SceneMotion, FollowsWhoMoves) {
  const world::Camera camera = cameraOf();
  constexpr int kLeft = 30;
  constexpr int kRight = 40;
  const node::Mover walker{{kLeft * kCell - 20, 0, kRight * kCell + 20, camera.height}, 1.8F, 2.2F, {1.5F, 0.0F, 0.0F}};
  const auto cells = walkerBeforeWall(kLeft, kRight);
  SceneMotion motion;
  (void)motion.next(frameOf(camera, cells, 7.0));
  const auto vectors = motion.next(frameOf(camera, cells, 7.1, {walker}));
  const auto way = static_cast<std::int16_t>(std::lround(-4.0F * camera.focal() * 0.15F / 2.0F));
  for (int column = 0; column < cells->across(); ++column) {
    const bool isWalker = column >= kLeft && column < kRight;
    const MotionVector expected{isWalker ? way : std::int16_t{0}, 0};
    ASSERT_EQ(vectors[static_cast<std::size_t>(column)], expected) << column;
  }
  const node::Mover behind{walker.rect, 3.0F, 3.5F, walker.velocity};
  for (const MotionVector& each : motion.next(frameOf(camera, cells, 7.2, {behind}))) ASSERT_EQ(each, MotionVector{});
  // A part at the frame's corner, with cells beyond its edge.
  const node::Mover corner{{camera.width - 3, camera.height - 3, camera.width, camera.height}, 4.0F, 6.0F, {0.0F, 0.0F, 9.0F}};
  const auto after = motion.next(frameOf(camera, cells, 7.3, {corner}));
  EXPECT_NE(after.back(), MotionVector{});
  EXPECT_EQ(std::ranges::count(after, MotionVector{}), std::ssize(after) - 1);
}

// Fault: vectors between pictures whose pixels do not correspond, or from no nearness.
TEST(SceneMotion, IsUnknownAfterAChangeOfSize) {
  const world::Camera large = cameraOf();
  const world::Camera small = cameraOf(480, 270);
  const auto cells = look(large, groundAt);
  const auto smallCells = look(small, groundAt);
  SceneMotion motion;
  (void)motion.next(frameOf(large, cells));
  EXPECT_FALSE(motion.next(frameOf(large, cells)).empty());
  EXPECT_TRUE(motion.next(frameOf(small, smallCells)).empty());
  EXPECT_EQ(motion.next(frameOf(small, smallCells)).size(), smallCells->cells().size());
  EXPECT_TRUE(motion.next(frameOf(small, nullptr)).empty());
  EXPECT_FALSE(motion.next(frameOf(small, smallCells)).empty()) << "its camera is known all the same";
}

}  // namespace
}  // namespace grove::stream
