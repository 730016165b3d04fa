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

}  // namespace
}  // namespace grove::world
