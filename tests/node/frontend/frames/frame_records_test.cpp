#include "node/frontend/frames/frame_records.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "node/frontend/frame_lists.h"

namespace grove::node {
namespace {

using testing::colourOf;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using testing::listOf;
using testing::picture;

FrameRecord& openShown(FrameRecords& frames, FrameNumber number) {
  FrameRecord& frame = frames.open(listOf(number, 1));
  frames.show(frame);
  return frame;
}

TEST(FrameRecords, AcceptFramesInAnyOrder) {
  FrameRecords frames;
  FrameRecord& second = frames.open(listOf(2, 1));
  FrameRecord& first = frames.open(listOf(1, 1));
  EXPECT_EQ(frames.find(1), &first);
  EXPECT_EQ(frames.find(2), &second);
  EXPECT_EQ(frames.find(3), nullptr);
}

TEST(FrameRecords, ForgetTheOldestEnded) {
  FrameRecords frames;
  for (FrameNumber number = 1; number <= 100; ++number) openShown(frames, number);
  EXPECT_EQ(frames.size(), FrameRecords::kKept);
  EXPECT_EQ(frames.find(100 - FrameRecords::kKept), nullptr);
  EXPECT_NE(frames.find(101 - FrameRecords::kKept), nullptr);
}

TEST(FrameRecords, KeepUnfinishedAndNewestShown) {
  FrameRecords frames;
  openShown(frames, 1);
  frames.open(listOf(2, 1));
  for (FrameNumber number = 3; number <= 100; ++number) frames.open(listOf(number, 1)).drop();
  EXPECT_EQ(frames.size(), FrameRecords::kKept);
  EXPECT_NE(frames.find(1), nullptr);
  EXPECT_NE(frames.find(2), nullptr);
}

TEST(FrameRecords, ListOverdueOldestFirst) {
  FrameRecords frames;
  FrameRecord& second = frames.open(listOf(2, 1, {.deadline = 10.8}));
  FrameRecord& first = frames.open(listOf(1, 1, {.deadline = 10.5}));
  EXPECT_THAT(frames.overdue(10.4), IsEmpty());
  EXPECT_THAT(frames.overdue(10.6), ElementsAre(&first)) << "the newer one has time";
  EXPECT_THAT(frames.overdue(10.8), ElementsAre(&first, &second));
  frames.show(first);
  EXPECT_THAT(frames.overdue(10.8), ElementsAre(&second));
}

TEST(FrameRecords, NewerShownFramesOvertake) {
  FrameRecords frames;
  FrameRecord& first = frames.open(listOf(1, 1));
  FrameRecord& second = frames.open(listOf(2, 1));
  EXPECT_FALSE(frames.overtaken(first));
  frames.show(second);
  EXPECT_TRUE(frames.overtaken(first));
  EXPECT_FALSE(frames.overtaken(frames.open(listOf(3, 1))));
}

TEST(FrameRecords, OnlyTheNewestShownKeepsPayloads) {
  FrameRecords frames;
  FrameRecord& first = frames.open(listOf(1, 1));
  Payload payload = picture(5);
  first.answer(0, payload);
  frames.show(first);
  FrameRecord& filled = frames.open(listOf(2, 1));
  frames.fillIn(filled);
  EXPECT_EQ(colourOf(filled.toShow().payloads[0]), 5U);
  frames.show(filled);
  EXPECT_EQ(colourOf(first.toShow().payloads[0]), 0U);
  EXPECT_EQ(colourOf(filled.toShow().payloads[0]), 5U);
}

TEST(FrameRecords, KeepLateResults) {
  FrameRecords frames;
  FrameRecord& dropped = frames.open(listOf(1, 1));
  EXPECT_FALSE(frames.keepStale(dropped, 0, picture(4))) << "nothing was shown yet";
  dropped.drop();
  FrameRecord& late = openShown(frames, 2);
  openShown(frames, 3);
  EXPECT_FALSE(frames.keepStale(dropped, 0, picture(4))) << "it was not shown";
  EXPECT_TRUE(frames.keepStale(late, 0, picture(5)));
  FrameRecord& next = frames.open(listOf(4, 1));
  frames.fillIn(next);
  EXPECT_EQ(colourOf(next.toShow().payloads[0]), 5U);
}

TEST(FrameRecords, DropLateResultsAfterNewerAnswers) {
  FrameRecords frames;
  FrameRecord& late = openShown(frames, 1);
  FrameRecord& newest = frames.open(listOf(2, 1));
  Payload payload = picture(6);
  newest.answer(0, payload);
  frames.show(newest);
  EXPECT_FALSE(frames.keepStale(late, 0, picture(5)));
}

}  // namespace
}  // namespace grove::node
