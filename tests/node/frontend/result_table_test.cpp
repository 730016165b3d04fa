#include "node/frontend/result_table.h"

#include <gtest/gtest.h>

namespace grove::node {
namespace {

std::shared_ptr<const FrameList> frameOf(FrameNumber number, std::size_t requests, double deadline = 1.0) {
  auto view = std::make_shared<View>();
  view->frame = number;
  view->deadline = deadline;
  auto list = std::make_shared<FrameList>();
  list->view = view;
  list->objects.resize(requests);
  return list;
}

bool put(ResultTable& table, FrameNumber frame, std::uint32_t slot, const std::string& reason) {
  Payload payload = Failure{reason};
  return table.put(frame, slot, payload);
}

TEST(ResultTable, AssemblesResultsThatComeInAnyOrderOfAnyFrame) {
  ResultTable table(2);
  ASSERT_TRUE(table.open(frameOf(1, 3)));
  ASSERT_TRUE(table.open(frameOf(2, 2)));
  EXPECT_TRUE(put(table, 2, 1, "2b"));
  EXPECT_TRUE(put(table, 1, 2, "1c"));
  EXPECT_TRUE(put(table, 2, 0, "2a"));
  EXPECT_FALSE(table.take(1).has_value());
  const auto second = table.take(2);
  ASSERT_TRUE(second.has_value()) << "the later frame is complete first";
  EXPECT_EQ(std::get<Failure>(second->payloads[0]).reason, "2a");
  EXPECT_EQ(std::get<Failure>(second->payloads[1]).reason, "2b");
  EXPECT_TRUE(put(table, 1, 0, "1a"));
  EXPECT_TRUE(put(table, 1, 1, "1b"));
  const auto first = table.take(1);
  ASSERT_TRUE(first.has_value());
  EXPECT_EQ(std::get<Failure>(first->payloads[2]).reason, "1c");
  EXPECT_EQ(table.frames(), 0u);
}

TEST(ResultTable, HoldsNoMoreFramesThanAreInFlight) {
  ResultTable table(2);
  EXPECT_TRUE(table.open(frameOf(1, 1)));
  EXPECT_TRUE(table.open(frameOf(2, 1)));
  EXPECT_FALSE(table.open(frameOf(3, 1)));
  EXPECT_FALSE(table.open(frameOf(2, 1)));
  EXPECT_EQ(table.frames(), 2u);
}

TEST(ResultTable, RefusesWhatItDidNotAskFor) {
  ResultTable table(2);
  ASSERT_TRUE(table.open(frameOf(7, 2)));
  EXPECT_FALSE(put(table, 8, 0, "unknown frame"));
  EXPECT_FALSE(put(table, 7, 2, "unknown slot"));
  EXPECT_TRUE(put(table, 7, 0, "first"));
  EXPECT_FALSE(put(table, 7, 0, "second answer"));
  EXPECT_TRUE(put(table, 7, 1, ""));
  EXPECT_EQ(std::get<Failure>(table.take(7)->payloads[0]).reason, "first");
}

TEST(ResultTable, AFrameWithoutRequestsIsCompleteAtOnce) {
  ResultTable table(1);
  ASSERT_TRUE(table.open(frameOf(1, 0)));
  EXPECT_TRUE(table.take(1).has_value());
}

TEST(ResultTable, ALostResultDoesNotKeepItsRow) {
  ResultTable table(2);
  ASSERT_TRUE(table.open(frameOf(3, 2, 10.5)));
  ASSERT_TRUE(table.open(frameOf(4, 1, 10.8)));
  ASSERT_TRUE(put(table, 3, 1, "came"));
  EXPECT_FALSE(table.takeOverdue(10.49).has_value());
  const auto overdue = table.takeOverdue(10.6);
  ASSERT_TRUE(overdue.has_value());
  EXPECT_EQ(overdue->list->view->frame, 3u);
  EXPECT_EQ(overdue->fulfilled, (std::vector<bool>{false, true}));
  EXPECT_EQ(std::get<Failure>(overdue->payloads[1]).reason, "came");
  EXPECT_FALSE(put(table, 3, 0, "late")) << "nobody waits for it";
  EXPECT_EQ(table.frames(), 1u);
  EXPECT_FALSE(table.takeOverdue(10.6).has_value()) << "the newer one has time";
  EXPECT_TRUE(table.takeOverdue(10.8).has_value());
}

}  // namespace
}  // namespace grove::node
