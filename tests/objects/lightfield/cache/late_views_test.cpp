#include "objects/lightfield/cache/late_views.h"

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
