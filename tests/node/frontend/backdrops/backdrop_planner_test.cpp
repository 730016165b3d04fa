#include "node/frontend/backdrops/backdrop_planner.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "node/frontend/backdrops/drawn_backdrop.h"
#include "node/frontend/planner_stand.h"
#include "node/frontend/scene_analyzer.h"

namespace grove::node {
namespace {

using ::testing::ElementsAre;
using ::testing::UnorderedElementsAre;

constexpr world::ObjectId kHill = 1;
constexpr world::ObjectId kFire = 2;
constexpr world::ObjectId kTree = 3;  ///< beside the frame

std::vector<world::ObjectId> idsOf(const FrameList& list) {
  std::vector<world::ObjectId> ids;
  for (const VisibleObject& object : list.objects) ids.push_back(object.object.id);
  return ids;
}

/// A hill that stands still, a fire that does not, and a tree to the left.
class BackdropPlannerTest : public testing::PlannerStand {
 protected:
  BackdropPlannerTest() {
    const auto add = [&](world::ObjectId id, world::Vec3 centre) {
      layout.objects.push_back(testing::objectOf(id, {centre - 0.5F, centre + 0.5F}));
    };
    add(kHill, {0.0F, 1.7F, -20.0F});
    add(kFire, {1.0F, 1.7F, -8.0F});
    add(kTree, {-11.6F, 1.7F, -10.0F});
    stillness = [this](const VisibleObject& object) -> std::optional<float> {
      if (object.object.id == kFire) return std::nullopt;
      return distance;
    };
    camera.width = 640;
    camera.height = 360;
  }

  /// The next frame, a thirtieth of a second later.
  std::shared_ptr<const FrameList> plan() {
    View view;
    view.session = 1;
    view.frame = ++frame;
    view.camera = camera;
    view.time = time += 1.0 / 30.0;
    view.lights = lights;
    auto seen = std::make_shared<FrameList>();
    seen->objects = visibleObjects(layout, view);
    seen->view = std::make_shared<const View>(std::move(view));
    return planned.plan(std::move(seen));
  }
  /// In the Compositor's place: everything is a wall.
  void draw(const FrameList& list) {
    const auto painter = [this](const world::Camera&, world::Vec3) { return testing::Pixel{0xFFFFFFFFU, wall}; };
    backdrops->put(testing::backdropOf(testing::paint(painter, list.view->camera, list.area), View(*list.view)));
  }
  /// Draws backdrops for some frames, so that the way of the eye is known.
  void drawSome() {
    for (int i = 0; i < 3; ++i) {
      if (const auto list = plan(); list->drawsBackdrop()) draw(*list);
    }
  }

  float distance = 10.0F;
  float wall = 20.0F;  ///< metres
  world::Camera camera;
  std::vector<world::PointLight> lights;
  FrameNumber frame = 0;
  double time = 100.0;
  float factor = 1.0F;
  BackdropPlanner planned{layout, halves, backdrops, [this] { return factor; }};
};

TEST_F(BackdropPlannerTest, DrawsOnceAndThenOnlyWhatMoves) {
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

TEST_F(BackdropPlannerTest, DrawsAgainWhenItIsOld) {
  draw(*plan());
  int drawn = 0;
  for (int i = 0; i < 30; ++i) {
    const auto list = plan();
    if (!list->drawsBackdrop()) continue;
    draw(*list);
    ++drawn;
  }
  EXPECT_EQ(drawn, 1) << "each half second and a frame";
}

TEST_F(BackdropPlannerTest, DrawsAgainAfterACut) {
  draw(*plan());
  EXPECT_FALSE(plan()->drawsBackdrop());
  camera.pose.position.x += 10.0F;
  EXPECT_TRUE(plan()->drawsBackdrop()) << "a teleport";
}

TEST_F(BackdropPlannerTest, DrawsAgainInAnotherSize) {
  draw(*plan());
  EXPECT_FALSE(plan()->drawsBackdrop());
  camera.width = 480;
  EXPECT_TRUE(plan()->drawsBackdrop());
}

TEST_F(BackdropPlannerTest, DrawsAgainWhenTheLightChanges) {
  lights = {{{0.0F, 1.0F, -8.0F}, {4.0F, 2.0F, 1.0F}}};
  draw(*plan());
  lights[0].colour *= 1.1F;
  EXPECT_FALSE(plan()->drawsBackdrop());
  lights[0].colour *= 2.0F;
  EXPECT_TRUE(plan()->drawsBackdrop());
}

TEST_F(BackdropPlannerTest, DrawsABorderWhereTheHeadTurnsAndWhatIsInIt) {
  drawSome();
  for (int i = 0; i < 2; ++i) {
    camera.pose.yaw += 0.05F;
    const auto list = plan();
    if (!list->drawsBackdrop()) continue;
    draw(*list);
    EXPECT_LT(list->area.left, -20);
    EXPECT_EQ(list->area.right, 640);
    EXPECT_THAT(idsOf(*list), UnorderedElementsAre(kHill, kFire, kTree));
    camera.pose.yaw += 0.05F;
    EXPECT_FALSE(plan()->drawsBackdrop()) << "the border serves the next frame";
    return;
  }
  FAIL() << "it never drew a border";
}

TEST_F(BackdropPlannerTest, WhatIsNearIsDrawnInEveryFrame) {
  distance = 0.5F;
  const auto list = plan();
  EXPECT_FALSE(list->backdrop) << "nothing is left for a backdrop";
  EXPECT_THAT(idsOf(*list), UnorderedElementsAre(kHill, kFire));
}

TEST_F(BackdropPlannerTest, WhatComesIntoSightIsDrawnUntilABackdropHoldsIt) {
  draw(*plan());
  layout.objects.push_back(testing::objectOf(9, {{2.0F, 1.0F, -21.0F}, {3.0F, 2.0F, -20.0F}}));
  EXPECT_THAT(idsOf(*plan()), UnorderedElementsAre(kFire, 9U));
}

TEST_F(BackdropPlannerTest, AFrameThatIsDroppedLeavesItToTheNext) {
  const auto first = plan();
  ASSERT_TRUE(first->drawsBackdrop());
  planned.drop(first->view->frame);
  EXPECT_TRUE(plan()->drawsBackdrop());
}

TEST_F(BackdropPlannerTest, OneThatIsStillBeingDrawnServesTheNextFrameOnly) {
  EXPECT_TRUE(plan()->drawsBackdrop());
  EXPECT_FALSE(plan()->drawsBackdrop());
  EXPECT_TRUE(plan()->drawsBackdrop()) << "the first was never drawn";
}

/// Fails if each frame pays for a border that no other frame uses.
TEST_F(BackdropPlannerTest, PausesWhereBackdropsServeNoOtherFrame) {
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
TEST_F(BackdropPlannerTest, ABusyMachineShowsBackdropsWithLargerErrors) {
  lights = {{{0.0F, 1.0F, -8.0F}, {4.0F, 2.0F, 1.0F}}};
  factor = 4.0F;
  draw(*plan());
  camera.pose.position.z = -2.8F;  // of 20
  EXPECT_FALSE(plan()->drawsBackdrop());
  factor = 1.0F;
  const auto nearer = plan();
  EXPECT_TRUE(nearer->drawsBackdrop());
  draw(*nearer);
  factor = 4.0F;
  lights[0].colour *= 1.5F;
  EXPECT_FALSE(plan()->drawsBackdrop());
  factor = 1.0F;
  EXPECT_TRUE(plan()->drawsBackdrop());
}

/// Fails if a visitor amid leaves, where every backdrop is wrong at once, has one drawn in each frame of a busy machine.
TEST_F(BackdropPlannerTest, OnABusyMachineABackdropServesSomeFramesWhateverItsError) {
  factor = 4.0F;
  wall = 0.5F;
  draw(*plan());
  for (int i = 0; i < 3; ++i) {
    camera.pose.position.z -= 0.1F;
    EXPECT_FALSE(plan()->drawsBackdrop()) << i;
  }
  camera.pose.position.z -= 0.1F;
  EXPECT_TRUE(plan()->drawsBackdrop());
}

TEST_F(BackdropPlannerTest, WhoStopsTurningLacksNothingAtTheEdges) {
  drawSome();
  factor = 4.0F;
  camera.pose.yaw -= 0.03F;  // about 16 pixels, of 32 that may be missing
  EXPECT_FALSE(plan()->drawsBackdrop());
  EXPECT_TRUE(plan()->drawsBackdrop()) << "he would look at repeated pixels";
}

TEST_F(BackdropPlannerTest, ABusyMachineDrawsNearerObjectsIntoBackdrops) {
  distance = 1.0F;
  EXPECT_FALSE(plan()->backdrop);
  factor = 4.0F;
  const auto list = plan();
  EXPECT_TRUE(list->drawsBackdrop());
  for (const VisibleObject& object : list->objects) EXPECT_EQ(object.still, object.object.id == kHill);
}

}  // namespace
}  // namespace grove::node
