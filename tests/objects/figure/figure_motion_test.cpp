#include "objects/figure/frontend/figure_motion.h"

#include <gtest/gtest.h>

#include "objects/figure/backend/figure_model.h"
#include "objects/figure/common/stature.h"
#include "objects/figure/frontend/figure_labels.h"
#include "objects/figure/visitors_in_sight.h"

namespace grove::objects::figure {
namespace {

world::Player walking(world::PlayerId id, world::Vec3 velocity) {
  world::Player player;
  player.id = id;
  player.velocity = velocity;
  return player;
}

std::optional<node::Mover> moverAt(world::Vec3 feet, world::Vec3 velocity) {
  return moverOf(visitor(1, feet), walking(1, velocity), look({}, {})->view->camera);
}

// Faults: a part without the hood or the boots, which stay behind; depths that a hand is outside of.
TEST(FigureMotion, EnclosesTheFigure) {
  const world::Vec3 velocity(1.0F, 0.0F, -1.0F);
  const auto mover = moverAt({0.5F, 0.0F, -6.0F}, velocity);
  ASSERT_TRUE(mover);
  EXPECT_EQ(mover->velocity, velocity);
  const world::Camera camera = look({}, {})->view->camera;
  for (const float height : {0.0F, kFigureHeight * kStatures[1].height}) {
    for (const float side : {-0.35F, 0.35F}) {
      const world::Vec3 place = camera.project({0.5F + side, height, -6.0F});
      EXPECT_GE(place.x, static_cast<float>(mover->rect.left));
      EXPECT_LE(place.x, static_cast<float>(mover->rect.right));
      EXPECT_GE(place.y, static_cast<float>(mover->rect.top));
      EXPECT_LE(place.y, static_cast<float>(mover->rect.bottom));
    }
  }
  EXPECT_TRUE(mover->isAt(1.0F / 5.65F));
  EXPECT_TRUE(mover->isAt(1.0F / 6.35F));
  EXPECT_FALSE(mover->isAt(1.0F / 5.0F)) << "somebody in front";
  EXPECT_FALSE(mover->isAt(0.0F)) << "the sky";
}

// Faults: bits for visitors whose motion nobody sees; a division by a depth of zero.
TEST(FigureMotion, IsOfVisibleWalkers) {
  const world::Vec3 velocity(1.4F, 0.0F, 0.0F);
  EXPECT_FALSE(moverAt({0.5F, 0.0F, -6.0F}, {})) << "stands";
  EXPECT_FALSE(moverAt({0.5F, 0.0F, -30.0F}, velocity)) << "far away";
  EXPECT_FALSE(moverAt({0.5F, 0.0F, 6.0F}, velocity)) << "behind the visitor";
  EXPECT_FALSE(moverAt({40.0F, 0.0F, -6.0F}, velocity)) << "beside the picture";
  EXPECT_FALSE(moverAt({0.0F, 0.0F, -0.3F}, velocity)) << "around the eye";
}

// Fault: the layer of another visitor's motion, or of the visitor's own.
TEST(FigureMotion, ComesWithItsLayer) {
  const auto list = look({visitor(1, {0.5F, 0, -6}), visitor(2, {-0.5F, 0, -6}), visitor(3, {0, 0, -7})},
                         {walking(1, {1.0F, 0.0F, 0.0F}), walking(2, {0.0F, 0.0F, 2.0F}), walking(3, {})});
  FigureLabels labels;
  const auto moverIn = [&](std::size_t object) { return labels.layer(list->objects[object], {}, *list->view)->mover(); };
  ASSERT_TRUE(moverIn(0));
  EXPECT_EQ(moverIn(0)->velocity.x, 1.0F);
  ASSERT_TRUE(moverIn(1));
  EXPECT_EQ(moverIn(1)->velocity.z, 2.0F);
  EXPECT_FALSE(moverIn(2));
}

}  // namespace
}  // namespace grove::objects::figure
