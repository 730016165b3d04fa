#include "node/frontend/backdrops/backdrop_planner.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "node/frontend/backdrops/backdrop_area.h"
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

/// Everything near the origin reflects a radiance of 0.1.
const world::PointLight kFarLamp{{0.0F, 0.0F, 1000.0F}, world::Vec3(0.1e6F)};

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
    const std::shared_ptr<const View>& eye = list.backdropEye();
    backdrops->put(
        testing::backdropOf(testing::paint(painter, eye->camera, list.area), {eye, list.view->frame, isFinal}));
  }
  /// Draws backdrops for some frames, so that the way of the eye is known.
  void drawSome() {
    for (int i = 0; i < 3; ++i) {
      if (const auto list = plan(); list->drawsBackdrop()) draw(*list);
    }
  }

  float distance = 10.0F;
  float wall = 20.0F;  ///< metres
  bool isFinal = true;
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
  lights = {kFarLamp};
  draw(*plan());
  lights[0].colour *= 1.1F;
  EXPECT_FALSE(plan()->drawsBackdrop());
  lights[0].colour *= 2.0F;
  EXPECT_TRUE(plan()->drawsBackdrop());
}

TEST_F(BackdropPlannerTest, DrawsABorderWhereTheHeadTurnsAndWhatIsInIt) {
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

/// Fails if who looks around has everything drawn anew whenever the border is used up.
TEST_F(BackdropPlannerTest, DrawsOnlyWhatIsMissingWhereTheHeadTurnsOn) {
  drawSome();
  const auto base = backdrops->newest();
  camera.pose.yaw += 0.05F;
  const auto list = plan();
  ASSERT_TRUE(list->drawsBackdrop());
  EXPECT_EQ(list->extended, base->origin().frame);
  EXPECT_EQ(list->eye, base->origin().view);
  const world::Rect before = base->image().rect;
  EXPECT_EQ(world::overlap(list->area, before), before);
  EXPECT_LT(list->area.left, -20);
  EXPECT_EQ(list->drawn, partsBeyond(list->area, before));
  EXPECT_THAT(idsOf(*list), UnorderedElementsAre(kTree, kFire)) << "the hill is in the backdrop";
  for (const VisibleObject& object : list->objects) {
    EXPECT_EQ(object.still, object.object.id == kTree);
    EXPECT_EQ(list->eyeOf(object), object.still ? base->origin().view : list->view);
    if (object.still) {
      EXPECT_TRUE(world::overlap(object.rect, before).empty());
    }
  }
  draw(*list);
  camera.pose.yaw += 0.05F;
  const auto next = plan();
  EXPECT_FALSE(next->drawsBackdrop()) << "the border serves the next frame";
  EXPECT_EQ(next->backdrop, list->view->frame);
  EXPECT_THAT(idsOf(*next), ElementsAre(kFire)) << "the tree is in the backdrop, too";
}

/// Fails if an object shows twice, or in a part of the backdrop only.
TEST_F(BackdropPlannerTest, WhatTheBackdropLacksIsDrawnInEveryFrameThoughItIsExtended) {
  drawSome();
  layout.objects.push_back(testing::objectOf(9, {{-12.0F, 1.0F, -13.0F}, {-9.0F, 3.0F, -12.0F}}));
  camera.pose.yaw += 0.05F;
  const auto list = plan();
  ASSERT_TRUE(list->extended);
  const auto found = std::ranges::find(list->objects, 9U, [](const VisibleObject& o) { return o.object.id; });
  ASSERT_NE(found, list->objects.end());
  EXPECT_FALSE(found->still);
  draw(*list);
  EXPECT_THAT(idsOf(*plan()), UnorderedElementsAre(kFire, 9U));
}

TEST_F(BackdropPlannerTest, DoesNotExtendWhatIsSoonTooWrong) {
  drawSome();
  camera.pose.yaw += 0.05F;
  camera.pose.position.z -= 1.1F;  // of 20 metres, of which 1.3 are permitted
  const auto list = plan();
  EXPECT_TRUE(list->drawsBackdrop());
  EXPECT_FALSE(list->extended);
}

TEST_F(BackdropPlannerTest, AnExtensionThatIsDroppedHasAllDrawn) {
  drawSome();
  camera.pose.yaw += 0.05F;
  const auto list = plan();
  ASSERT_TRUE(list->extended);
  planned.drop(list->view->frame);
  const auto next = plan();
  EXPECT_TRUE(next->drawsBackdrop());
  EXPECT_FALSE(next->extended);
}

/// Fails if a visitor who spins has a picture that grows without end, or is left with one that he has turned away from.
TEST_F(BackdropPlannerTest, TurningRoundDrawsAllNowAndThen) {
  for (world::ObjectId id = 10; id < 40; ++id) {
    const float angle = 0.21F * static_cast<float>(id);
    const world::Vec3 centre(20.0F * std::sin(angle), 1.7F, 20.0F * std::cos(angle));
    layout.objects.push_back(testing::objectOf(id, {centre - 0.5F, centre + 0.5F}));
  }
  drawSome();
  int extended = 0;
  int drawn = 0;
  for (int i = 0; i < 210; ++i) {
    camera.pose.yaw += 0.03F;
    const auto list = plan();
    if (!list->drawsBackdrop()) {
      EXPECT_FALSE(seenPart(backdrops->newest()->view().camera, camera, 3.0F).empty());
      continue;
    }
    ++(list->extended ? extended : drawn);
    EXPECT_LE(list->area.width() * list->area.height(), 2 * 640 * 360);
    draw(*list);
  }
  EXPECT_GE(extended, 6);
  EXPECT_GE(drawn, 6);
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

/// Fails if a visitor amid leaves, where every backdrop is wrong at once, has one drawn in each frame of a busy
/// machine.
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
