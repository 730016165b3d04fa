#include "world/edits.h"

#include <gtest/gtest.h>

namespace grove::world {
namespace {

Gust strong(float speed) {
  Gust gust;
  gust.speed = speed;
  return gust;
}

TEST(Edits, EachReaderSeesEachGustOnce) {
  Edits edits;
  Edits::Cursor a = 0;
  Edits::Cursor b = 0;
  edits.add(strong(1));
  EXPECT_EQ(edits.after(a).size(), 1u);
  edits.add(strong(2));
  const auto forA = edits.after(a);
  ASSERT_EQ(forA.size(), 1u);
  EXPECT_EQ(forA[0].speed, 2.0F);
  EXPECT_EQ(edits.after(b).size(), 2u);
  EXPECT_TRUE(edits.after(b).empty());
}

TEST(Edits, KeepsTheNewestWhenNobodyReads) {
  Edits edits;
  for (int i = 0; i < 1000; ++i) edits.add(strong(static_cast<float>(i)));
  Edits::Cursor cursor = 0;
  const auto gusts = edits.after(cursor);
  EXPECT_EQ(gusts.size(), 256u);
  EXPECT_EQ(gusts.back().speed, 999.0F);
  EXPECT_EQ(gusts.front().speed, 744.0F);
}

Player holding(PlayerId id, std::uint8_t keys) {
  Player player;
  player.id = id;
  player.keys = keys;
  return player;
}

Gust clickOf(PlayerId id) {
  Gust gust;
  gust.visitor = id;
  return gust;
}

TEST(Gusts, WhoHoldsTheKeyBlowsOnceATickHoweverManyClicksOfHisThereAre) {
  const std::vector<Player> visitors{holding(1, kBlow | kForward), holding(2, kForward)};
  const auto gusts = gustsDuring({clickOf(1), clickOf(2), clickOf(1)}, visitors);
  ASSERT_EQ(gusts.size(), 2U);
  EXPECT_EQ(gusts[0].visitor, 2U) << "his click was shorter than the tick";
  EXPECT_EQ(gusts[1].visitor, 1U);
  EXPECT_EQ(gustsDuring({}, visitors).size(), 1U) << "and goes on at the next tick";
}

TEST(Gusts, BlowFromTheEyeWhereItLooks) {
  Player player = holding(7, kBlow);
  player.pose = {{1.0F, 1.7F, 2.0F}, 0.5F, 0.1F};
  const Gust gust = gustOf(player);
  EXPECT_EQ(gust.origin, player.pose.position);
  EXPECT_EQ(gust.direction, player.pose.forward());
}

}  // namespace
}  // namespace grove::world
