#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "node/frontend/backdrops/backdrop_area.h"
#include "node/frontend/backdrops/backdrop_planner_stand.h"
#include "node/frontend/backdrops/warp_error.h"
#include "node/limits.h"

/// What the Backdrop Planner does on a machine that has no time to draw a backdrop whenever it is wrong.
namespace grove::node {
namespace {

using testing::idsOf;
using testing::kFire;
using testing::kHill;

class BusyBackdrops : public testing::BackdropPlannerStand {
 protected:
  static constexpr float kStep = 0.05F;  ///< metres in a frame

  BusyBackdrops() { factor = 4.0F; }

  std::shared_ptr<const FrameList> planStep() {
    camera.pose.position.z -= kStep;
    return plan();
  }
  /// The next list that draws a backdrop on the way of a visitor, who has walked for a while.
  std::shared_ptr<const FrameList> nextDrawn() {
    for (int i = 0; i < 200; ++i) {
      auto list = planStep();
      if (!list->drawsBackdrop()) continue;
      draw(*list);
      if (i > 10) return list;
    }
    return nullptr;
  }
  static float metresAhead(const FrameList& list) {
    return list.view->camera.pose.position.z - list.backdropEye()->camera.pose.position.z;
  }
};

/// Fails if a visitor amid leaves, where every backdrop is wrong at once, has one drawn in each frame.
TEST_F(BusyBackdrops, ServeAMinimumTime) {
  wall = 0.5F;
  draw(*plan());
  for (int i = 0; i < 9; ++i) EXPECT_FALSE(planStep()->drawsBackdrop()) << i;
  EXPECT_TRUE(planStep()->drawsBackdrop()) << "after 0.3 seconds";
}

/// Fails if all visitors' backdrops are drawn at the same time, or if a visitor waits without end.
TEST_F(BusyBackdrops, WaitForTheirTurn) {
  wall = 0.5F;
  draw(*plan());
  RedrawTurn other(turns);
  other.begin();
  for (int i = 0; i < 17; ++i) EXPECT_FALSE(planStep()->drawsBackdrop()) << i;
  planStep();
  time += 1e-3;
  const auto afterTwiceTheTime = plan();
  ASSERT_TRUE(afterTwiceTheTime->drawsBackdrop()) << "after 0.6 seconds";
  draw(*afterTwiceTheTime);
  for (int i = 0; i < 15; ++i) EXPECT_FALSE(planStep()->drawsBackdrop()) << i;
  other.end();
  EXPECT_TRUE(planStep()->drawsBackdrop());
}

/// Fails if all visitors have backdrops drawn at once when the size of their pictures changes.
TEST_F(BusyBackdrops, OfAnotherSizeServeUntilTheirTurn) {
  draw(*plan());
  RedrawTurn other(turns);
  other.begin();
  camera.width = 480;
  camera.height = 270;
  for (int i = 0; i < 5; ++i) EXPECT_FALSE(plan()->drawsBackdrop()) << i;
  other.end();
  const auto list = plan();
  ASSERT_TRUE(list->drawsBackdrop());
  EXPECT_EQ(list->backdropEye()->camera.height, 270);
  draw(*list);
  other.begin();
  camera.width = 160;
  camera.height = 90;
  EXPECT_TRUE(plan()->drawsBackdrop()) << "a third of the size would be seen";
}

/// Fails if other visitors wait for a backdrop that is complete or that is never drawn.
TEST_F(BusyBackdrops, ReturnTheirTurn) {
  const auto first = plan();
  ASSERT_TRUE(first->drawsBackdrop());
  EXPECT_FALSE(turns.isFree());
  draw(*first);
  EXPECT_TRUE(turns.isFree());
  time += 4.0;
  const auto next = plan();
  ASSERT_TRUE(next->drawsBackdrop());
  EXPECT_FALSE(turns.isFree());
  planned.drop(next->view->frame);
  EXPECT_TRUE(turns.isFree());
}

/// Fails if a backdrop is right at first and then only gets worse: drawn from ahead, it serves for a longer way.
TEST_F(BusyBackdrops, AreDrawnAheadOfWalkers) {
  wall = 5.0F;
  const auto list = nextDrawn();
  ASSERT_TRUE(list);
  EXPECT_GT(metresAhead(*list), 2.0F * kStep);
  EXPECT_LE(metresAhead(*list), 0.401F);
  ASSERT_TRUE(list->view->backdropPose);
  EXPECT_EQ(*list->view->backdropPose, list->eye->camera.pose);
  EXPECT_EQ(list->eye->frame, list->view->frame) << "backends know it by this number";
  const world::Rect seen = seenPart(list->eye->camera, list->view->camera, 3.0F);
  EXPECT_EQ(world::overlap(list->area, seen), seen) << "the frame shows it from behind";
  EXPECT_LT(list->area.left, 0);
  EXPECT_GT(list->area.bottom, camera.height);
}

/// Fails if what is farther is drawn from farther ahead than any border can hold, or what is near from as far.
TEST_F(BusyBackdrops, LookAheadIsBoundedByTheError) {
  wall = 100.0F;
  const auto far = nextDrawn();
  ASSERT_TRUE(far);
  EXPECT_NEAR(metresAhead(*far), 0.4F, 0.001F);
  wall = 1.0F;
  ASSERT_TRUE(nextDrawn());
  const auto near = nextDrawn();
  ASSERT_TRUE(near);
  EXPECT_LT(metresAhead(*near), 0.3F);
}

TEST_F(BusyBackdrops, StaticFromBackdropEyeMovingFromVisitorEye) {
  const auto list = nextDrawn();
  ASSERT_TRUE(list);
  EXPECT_THAT(idsOf(*list), ::testing::IsSupersetOf({kHill, kFire}));
  for (const VisibleObject& object : list->objects) {
    EXPECT_EQ(object.still, object.object.id != kFire);
    EXPECT_EQ(list->eyeOf(object), object.still ? list->eye : list->view);
    const View& eye = *list->eyeOf(object);
    const world::Rect box = eye.camera.screenRect(object.object.bounds);
    EXPECT_EQ(world::overlap(object.rect, box), box) << object.object.id;
  }
}

/// Fails if what is near, which each frame draws, is drawn into the backdrop from ahead, or not at all.
TEST_F(BusyBackdrops, LeaveNearObjectsToEachFrame) {
  factor = 3.0F;
  wall = 1.0F;
  stillness = [](const VisibleObject& object) -> std::optional<float> {
    return object.distance < 19.0F ? 0.1F : 10.0F;
  };
  const auto list = nextDrawn();
  ASSERT_TRUE(list);
  EXPECT_THAT(idsOf(*list), ::testing::IsSupersetOf({kHill, kFire}));
  for (const VisibleObject& object : list->objects) {
    EXPECT_EQ(object.still, object.object.id == kHill) << object.object.id;
  }
}

TEST_F(BusyBackdrops, UseTheVisitorsEyeWhenIdleOrResting) {
  wall = 2.0F;
  factor = 1.0F;
  const auto list = nextDrawn();
  ASSERT_TRUE(list);
  EXPECT_EQ(list->backdropEye(), list->view);
  EXPECT_FALSE(list->view->backdropPose);
  factor = 4.0F;
  ASSERT_TRUE(nextDrawn());
  plan();
  time += 4.0;
  const auto atRest = plan();
  ASSERT_TRUE(atRest->drawsBackdrop()) << "the last one is old";
  EXPECT_EQ(atRest->backdropEye(), atRest->view);
}

/// Fails if who runs and turns at once has everything drawn anew for the border's sake.
TEST_F(BusyBackdrops, AreExtendedWhileInUse) {
  factor = 3.0F;
  wall = 0.6F;
  ASSERT_TRUE(nextDrawn());
  std::shared_ptr<const FrameList> list;
  for (int i = 0; i < 5 && !(list && list->drawsBackdrop()); ++i) {
    camera.pose.position.z -= 2.0F * kStep;
    camera.pose.yaw += 0.04F;
    list = planStep();
  }
  ASSERT_TRUE(list->drawsBackdrop());
  EXPECT_GT(warpError(*backdrops->newest(), camera), 0.7F * factor);
  EXPECT_TRUE(list->extended);
}

TEST_F(BusyBackdrops, RespectTheObjectLimit) {
  for (world::ObjectId id = 100; id < 100 + 2 * kMaxObjectsPerFrame; ++id) {
    layout.objects.push_back(testing::objectOf(id, {{-1.0F, 1.0F, -31.0F}, {1.0F, 3.0F, -30.0F}}));
  }
  const auto list = nextDrawn();
  ASSERT_TRUE(list);
  EXPECT_LE(list->objects.size(), kMaxObjectsPerFrame);
  EXPECT_EQ(list->objects.back().object.id, kFire) << "the nearest stay";
}

}  // namespace
}  // namespace grove::node
