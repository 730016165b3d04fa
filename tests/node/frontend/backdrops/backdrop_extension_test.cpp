#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "node/frontend/backdrops/backdrop_area.h"
#include "node/frontend/backdrops/backdrop_planner_stand.h"

/// What the Backdrop Planner does where the head turns beyond the border.
namespace grove::node {
namespace {

using ::testing::ElementsAre;
using testing::idsOf;
using testing::kFire;
using testing::kTree;
using ::testing::UnorderedElementsAre;

using BackdropExtension = testing::BackdropPlannerStand;

/// Fails if who looks around has everything drawn anew whenever the border is used up.
TEST_F(BackdropExtension, DrawsOnlyMissingPartsOnHeadTurns) {
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
TEST_F(BackdropExtension, MissingPartsAreDrawnDuringAnExtension) {
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

TEST_F(BackdropExtension, DoesNotExtendNearTheErrorBound) {
  drawSome();
  camera.pose.yaw += 0.05F;
  camera.pose.position.z -= 1.1F;  // of 20 metres, of which 1.3 are permitted
  const auto list = plan();
  EXPECT_TRUE(list->drawsBackdrop());
  EXPECT_FALSE(list->extended);
}

/// Fails if a frame shows a backdrop that it sees nothing of because the visitor, who turns on as fast, would be back
/// where he began.
TEST_F(BackdropExtension, DoesNotExtendBehindTheVisitor) {
  drawSome();
  camera.pose.yaw += 2.05F;  // three times that is once round
  const auto list = plan();
  EXPECT_FALSE(list->extended);
  EXPECT_FALSE(list->backdrop);
}

TEST_F(BackdropExtension, DroppedExtensionCausesAFullRedraw) {
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
TEST_F(BackdropExtension, FullTurnRedrawsSometimes) {
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

}  // namespace
}  // namespace grove::node
