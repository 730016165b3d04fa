#include "world/edits.h"

#include <gtest/gtest.h>

#include <vector>

namespace grove::world {
namespace {

Player visitor(PlayerId id) {
  Player player;
  player.id = id;
  return player;
}

TEST(Edits, GustsBlowEveryTickUntilReleased) {
  Edits edits;
  Edits::Cursor cursor = 0;
  std::vector<Player> visitors{visitor(1), visitor(2)};
  EXPECT_TRUE(edits.during(cursor, visitors).empty());
  edits.startBlowing(visitors[0]);
  for (int tick = 0; tick < 3; ++tick) {
    visitors[0].pose.position.x += 1.0F;
    const auto gusts = edits.during(cursor, visitors);
    ASSERT_EQ(gusts.size(), 1U) << "once, though he has just begun";
    EXPECT_EQ(gusts[0].visitor, 1U);
    EXPECT_EQ(gusts[0].origin, visitors[0].pose.position) << "from where he is by now";
  }
  edits.stopBlowing(1);
  EXPECT_TRUE(edits.during(cursor, visitors).empty());
}

TEST(Edits, ShortClickBlowsOncePerReader) {
  Edits edits;
  Edits::Cursor a = 0;
  Edits::Cursor b = 0;
  const std::vector<Player> visitors{visitor(1)};
  edits.startBlowing(visitors[0]);
  edits.stopBlowing(1);
  EXPECT_EQ(edits.during(a, visitors).size(), 1U);
  EXPECT_TRUE(edits.during(a, visitors).empty());
  EXPECT_EQ(edits.during(b, visitors).size(), 1U);
}

TEST(Edits, ManyClicksWithinATickBlowOnce) {
  Edits edits;
  Edits::Cursor cursor = 0;
  std::vector<Player> visitors{visitor(1), visitor(2)};
  for (int press = 0; press < 8; ++press) {
    visitors[0].pose.position.x = static_cast<float>(press);
    edits.startBlowing(visitors[0]);
    edits.stopBlowing(1);
  }
  edits.startBlowing(visitors[1]);
  edits.stopBlowing(2);
  const auto gusts = edits.during(cursor, visitors);
  ASSERT_EQ(gusts.size(), 2U);
  EXPECT_EQ(gusts[0].origin.x, 7.0F) << "the newest of his breaths";
  EXPECT_EQ(gusts[1].visitor, 2U);
}

TEST(Edits, LeavingEndsAGust) {
  Edits edits;
  Edits::Cursor cursor = 0;
  edits.startBlowing(visitor(1));
  EXPECT_TRUE(edits.during(cursor, {}).empty());
}

TEST(Edits, KeepsTheNewestWithoutReaders) {
  Edits edits;
  for (PlayerId id = 1; id <= 1000; ++id) {
    edits.startBlowing(visitor(id));
    edits.stopBlowing(id);
  }
  Edits::Cursor cursor = 0;
  const auto gusts = edits.during(cursor, {});
  ASSERT_EQ(gusts.size(), 256U);
  EXPECT_EQ(gusts.front().visitor, 745U);
  EXPECT_EQ(gusts.back().visitor, 1000U);
}

TEST(Gust, BlowsFromTheEyeWhereItLooks) {
  Player player = visitor(7);
  player.pose = {{1.0F, 1.7F, 2.0F}, 0.5F, 0.1F};
  const Gust gust = gustOf(player);
  EXPECT_EQ(gust.origin, player.pose.position);
  EXPECT_EQ(gust.direction, player.pose.forward());
  EXPECT_EQ(gust.visitor, 7U);
}

}  // namespace
}  // namespace grove::world
