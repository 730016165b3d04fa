#include "objects/lightfield/frontend/late_views.h"

#include <gtest/gtest.h>

namespace grove::objects::lightfield {
namespace {

node::View viewOf(node::SessionId session, node::FrameNumber frame) {
  node::View view;
  view.session = session;
  view.frame = frame;
  return view;
}

CellId cellOf(std::int32_t column) {
  CellId cell;
  cell.column = column;
  return cell;
}

TEST(LateViews, RemembersWhatEachVisitorWasShownLast) {
  LateViews late;
  EXPECT_FALSE(late.last(viewOf(1, 1), 5));
  late.shown(viewOf(1, 1), 5, cellOf(7));
  late.shown(viewOf(1, 1), 6, cellOf(8));
  late.shown(viewOf(2, 1), 5, cellOf(9));
  EXPECT_EQ(late.last(viewOf(1, 2), 5), cellOf(7));
  late.shown(viewOf(1, 2), 5, cellOf(10));
  EXPECT_EQ(late.last(viewOf(1, 3), 5), cellOf(10));
  EXPECT_EQ(late.last(viewOf(1, 3), 6), cellOf(8));
  EXPECT_EQ(late.last(viewOf(2, 2), 5), cellOf(9));
}

TEST(LateViews, WhatShowedAFormerLightFieldFadesAway) {
  LateViews late;
  const auto at = [](double time) {
    node::View view = viewOf(1, 1);
    view.time = time;
    return view;
  };
  CellId finer = cellOf(7);
  finer.version = 1;
  late.shown(at(1.0), 5, cellOf(7));
  EXPECT_FALSE(late.fading(at(1.1), 5)) << "there was nothing before";
  late.shown(at(2.0), 5, finer);
  const auto begun = late.fading(at(2.0), 5);
  ASSERT_TRUE(begun);
  EXPECT_EQ(begun->from, cellOf(7));
  EXPECT_EQ(begun->share, 0.0F) << "nothing jumps";
  // One who walks is shown other cells of the finer light field meanwhile.
  finer.column = 9;
  late.shown(at(2.4), 5, finer);
  float last = 0.0F;
  for (const double time : {2.25, 2.5, 2.75, 2.99}) {
    const auto fading = late.fading(at(time), 5);
    ASSERT_TRUE(fading) << time;
    EXPECT_EQ(fading->from, cellOf(7));
    EXPECT_GT(fading->share, last);
    last = fading->share;
  }
  EXPECT_GT(last, 0.99F);
  EXPECT_FALSE(late.fading(at(3.0), 5));
}

TEST(LateViews, MemoryIsBoundedWhoeverComes) {
  LateViews late;
  for (node::SessionId session = 1; session < 3000; ++session) {
    for (world::ObjectId object = 1; object <= 10; ++object) late.shown(viewOf(session, 1), object, cellOf(1));
  }
  EXPECT_FALSE(late.last(viewOf(1, 9), 1)) << "the first visitors are forgotten";
  EXPECT_TRUE(late.last(viewOf(2999, 9), 10));
}

}  // namespace
}  // namespace grove::objects::lightfield
