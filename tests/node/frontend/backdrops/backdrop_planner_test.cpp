#include "node/frontend/backdrops/backdrop_planner.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "node/frontend/backdrops/backdrop_planner_stand.h"

namespace grove::node {
namespace {

using ::testing::ElementsAre;
using testing::idsOf;
using testing::kFarLamp;
using testing::kFire;
using testing::kHill;
using testing::kTree;
using ::testing::UnorderedElementsAre;

using BackdropPlannerTest = testing::BackdropPlannerStand;

TEST_F(BackdropPlannerTest, DrawsOnceThenOnlyMovingObjects) {
  const auto first = plan();
  EXPECT_TRUE(first->drawsBackdrop());
  EXPECT_THAT(idsOf(*first), UnorderedElementsAre(kHill, kFire));
  for (const VisibleObject& object : first->objects) EXPECT_EQ(object.still, object.object.id == kHill);
  draw(*first);
  for (int i = 0; i < 10; ++i) {
    const auto next = plan();
    EXPECT_EQ(next->backdrop, first->view->frame);
    EXPECT_THAT(idsOf(*next), ElementsAre(kFire));
  }
}

TEST_F(BackdropPlannerTest, RedrawsAfterMaximumAge) {
  const auto drawnIn = [&](int frames) {
    int drawn = 0;
    for (int i = 0; i < frames; ++i) {
      const auto list = plan();
      if (!list->drawsBackdrop()) continue;
      draw(*list);
      ++drawn;
    }
    return drawn;
  };
  draw(*plan());
  EXPECT_EQ(drawnIn(88), 0);
  EXPECT_EQ(drawnIn(90), 1) << "every three seconds";
  isFinal = false;
  camera.pose.position.x += 10.0F;
  draw(*plan());
  EXPECT_EQ(drawnIn(90), 5) << "each half second and a frame, as long as something better is under way";
}

TEST_F(BackdropPlannerTest, RedrawsAfterACut) {
  draw(*plan());
  EXPECT_FALSE(plan()->drawsBackdrop());
  camera.pose.position.x += 10.0F;
  EXPECT_TRUE(plan()->drawsBackdrop()) << "a teleport";
}

TEST_F(BackdropPlannerTest, RedrawsAfterResize) {
  draw(*plan());
  EXPECT_FALSE(plan()->drawsBackdrop());
  camera.width = 480;
  EXPECT_TRUE(plan()->drawsBackdrop());
}

TEST_F(BackdropPlannerTest, RedrawsAfterLightChange) {
  lights = {kFarLamp};
  draw(*plan());
  lights[0].colour *= 1.1F;
  EXPECT_FALSE(plan()->drawsBackdrop());
  lights[0].colour *= 2.0F;
  EXPECT_TRUE(plan()->drawsBackdrop());
}

TEST_F(BackdropPlannerTest, DrawsABorderTowardsHeadTurns) {
  drawSome();
  camera.pose.yaw += 0.05F;
  planned.drop(plan()->view->frame);
  camera.pose.yaw += 0.02F;
  const auto list = plan();
  ASSERT_TRUE(list->drawsBackdrop());
  EXPECT_FALSE(list->extended);
  draw(*list);
  EXPECT_LT(list->area.left, -20);
  EXPECT_EQ(list->area.right, 640);
  EXPECT_THAT(list->drawn, ElementsAre(list->area));
  EXPECT_THAT(idsOf(*list), UnorderedElementsAre(kHill, kFire, kTree));
  camera.pose.yaw += 0.02F;
  EXPECT_FALSE(plan()->drawsBackdrop()) << "the border serves the next frame";
}

TEST_F(BackdropPlannerTest, NearObjectsAreDrawnEveryFrame) {
  distance = 0.5F;
  const auto list = plan();
  EXPECT_FALSE(list->backdrop) << "nothing is left for a backdrop";
  EXPECT_THAT(idsOf(*list), UnorderedElementsAre(kHill, kFire));
}

TEST_F(BackdropPlannerTest, NewlyVisibleObjectsAreDrawnUntilTheNextBackdrop) {
  draw(*plan());
  layout.objects.push_back(testing::objectOf(9, {{2.0F, 1.0F, -21.0F}, {3.0F, 2.0F, -20.0F}}));
  EXPECT_THAT(idsOf(*plan()), UnorderedElementsAre(kFire, 9U));
}

TEST_F(BackdropPlannerTest, NextFrameRedrawsAfterADrop) {
  const auto first = plan();
  ASSERT_TRUE(first->drawsBackdrop());
  planned.drop(first->view->frame);
  EXPECT_TRUE(plan()->drawsBackdrop());
}

TEST_F(BackdropPlannerTest, UnfinishedBackdropServesOnlyTheNextFrame) {
  EXPECT_TRUE(plan()->drawsBackdrop());
  EXPECT_FALSE(plan()->drawsBackdrop());
  EXPECT_TRUE(plan()->drawsBackdrop()) << "the first was never drawn";
}

/// Fails if each frame pays for a border that no other frame uses.
TEST_F(BackdropPlannerTest, PausesWhereBackdropsServeOneFrame) {
  int drawn = 0;
  for (int i = 0; i < 60; ++i) {
    camera.pose.yaw += 1.0F;
    const auto list = plan();
    if (!list->drawsBackdrop()) continue;
    draw(*list);
    ++drawn;
  }
  EXPECT_LE(drawn, 21);
}

/// Fails if a machine at its limit keeps to an accuracy that it has no time for.
TEST_F(BackdropPlannerTest, BusyMachineAllowsLargerErrors) {
  lights = {kFarLamp};
  factor = 4.0F;
  draw(*plan());
  camera.pose.position.z = -2.8F;  // of 20
  EXPECT_FALSE(plan()->drawsBackdrop());
  factor = 1.0F;
  const auto nearer = plan();
  EXPECT_TRUE(nearer->drawsBackdrop());
  draw(*nearer);
  factor = 4.0F;
  lights[0].colour *= 2.0F;
  EXPECT_FALSE(plan()->drawsBackdrop());
  factor = 1.0F;
  EXPECT_TRUE(plan()->drawsBackdrop());
}

TEST_F(BackdropPlannerTest, StoppedTurnHasCompleteEdges) {
  drawSome();
  factor = 4.0F;
  camera.pose.yaw -= 0.03F;  // about 16 pixels, of 32 that may be missing
  EXPECT_FALSE(plan()->drawsBackdrop());
  EXPECT_TRUE(plan()->drawsBackdrop()) << "he would look at repeated pixels";
}

TEST_F(BackdropPlannerTest, BusyMachinePutsNearerObjectsIntoBackdrops) {
  distance = 1.0F;
  EXPECT_FALSE(plan()->backdrop);
  factor = 4.0F;
  const auto list = plan();
  EXPECT_TRUE(list->drawsBackdrop());
  for (const VisibleObject& object : list->objects) EXPECT_EQ(object.still, object.object.id == kHill);
}

}  // namespace
}  // namespace grove::node
