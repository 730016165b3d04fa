#include "node/frontend/frames/frame_record.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "node/frontend/frame_lists.h"

namespace grove::node {
namespace {

using testing::colourOf;
using ::testing::ElementsAre;
using testing::failure;
using ::testing::IsEmpty;
using testing::listOf;
using testing::picture;
using testing::reasonOf;

bool answers(FrameRecord& record, std::uint32_t slot, Payload payload) { return record.answer(slot, payload); }

/// A frame of two objects, shown with the first one's answer only, this one's colour being `colour`.
FrameRecord shownWithoutSecond(FrameNumber number, std::uint32_t colour, int width = 320) {
  FrameRecord record(listOf(number, 2, {.width = width}));
  answers(record, 0, picture(colour));
  record.fillIn({});
  record.show();
  return record;
}

TEST(FrameRecord, IsCompleteAfterAllSlotsInAnyOrder) {
  FrameRecord record(listOf(1, 3));
  EXPECT_TRUE(answers(record, 2, failure("c")));
  EXPECT_TRUE(answers(record, 0, failure("a")));
  EXPECT_FALSE(record.complete());
  EXPECT_TRUE(answers(record, 1, failure("b")));
  ASSERT_TRUE(record.complete());
  const CompleteFrame frame = record.toShow();
  EXPECT_EQ(frame.list, record.list());
  ASSERT_EQ(frame.payloads.size(), 3U);
  EXPECT_EQ(reasonOf(frame.payloads[0]), "a");
  EXPECT_EQ(reasonOf(frame.payloads[1]), "b");
  EXPECT_EQ(reasonOf(frame.payloads[2]), "c");
}

TEST(FrameRecord, ReportsStaleContent) {
  FrameRecord before(listOf(1, 2));
  answers(before, 0, picture(1));
  answers(before, 1, picture(2));
  EXPECT_FALSE(before.toShow().stale);
  before.show();
  FrameRecord record(listOf(2, 2));
  answers(record, 0, picture(3));
  record.fillIn({&before});
  EXPECT_TRUE(record.toShow().stale);
}

TEST(FrameRecord, IsCompleteWithoutObjects) { EXPECT_TRUE(FrameRecord(listOf(1, 0)).complete()); }

TEST(FrameRecord, RefusesSecondAnswersAndUnknownSlots) {
  FrameRecord record(listOf(7, 2));
  EXPECT_FALSE(answers(record, 2, failure("unknown slot")));
  EXPECT_TRUE(answers(record, 0, failure("first")));
  EXPECT_FALSE(answers(record, 0, failure("second")));
  EXPECT_FALSE(record.complete()) << "a second answer counts for no other slot";
  EXPECT_TRUE(answers(record, 1, failure("")));
  EXPECT_EQ(reasonOf(record.toShow().payloads[0]), "first");
}

TEST(FrameRecord, KeepsARefusedPayload) {
  FrameRecord record(listOf(1, 1));
  record.drop();
  Payload payload = failure("late");
  EXPECT_FALSE(record.answer(0, payload));
  EXPECT_EQ(reasonOf(payload), "late");
}

TEST(FrameRecord, TracksPendingSlots) {
  FrameRecord record(listOf(1, 2));
  EXPECT_EQ(record.asked(0), nullptr);
  EXPECT_EQ(record.asked(2), nullptr) << "there is no such slot";
  record.ask(0, {.shared = false, .key = "a", .rect = {}});
  record.ask(0, {.shared = false, .key = "b", .rect = {}});
  ASSERT_NE(record.asked(0), nullptr);
  EXPECT_EQ(record.asked(0)->key, "b");
  EXPECT_EQ(record.rounds(0), 2);
  EXPECT_EQ(record.rounds(1), 0);
  answers(record, 0, failure(""));
  EXPECT_EQ(record.asked(0), nullptr);
}

TEST(FrameRecord, IsOverdueBetweenDeadlineAndEnd) {
  FrameRecord record(listOf(1, 1, {.deadline = 10.5}));
  EXPECT_FALSE(record.overdue(10.49));
  EXPECT_TRUE(record.overdue(10.5));
  record.show();
  EXPECT_FALSE(record.overdue(11.0));
}

TEST(FrameRecord, FillsInFromTheLastFrame) {
  const FrameRecord last = shownWithoutSecond(1, 5);
  FrameRecord record(listOf(2, 3));
  ASSERT_TRUE(answers(record, 2, picture(9)));
  EXPECT_THAT(record.fillIn({&last}), ElementsAre(0U, 1U));
  const CompleteFrame frame = record.toShow();
  EXPECT_EQ(colourOf(frame.payloads[0]), 5U);
  EXPECT_EQ(reasonOf(frame.payloads[1]), "no result in time") << "the last one had no answer either";
  EXPECT_EQ(colourOf(frame.payloads[2]), 9U) << "its own";
}

TEST(FrameRecord, FillsInOnlyPicturesOfItsSize) {
  const FrameRecord last = shownWithoutSecond(1, 5, 640);
  FrameRecord record(listOf(2, 1));
  EXPECT_THAT(record.fillIn({&last}), ElementsAre(0U));
  EXPECT_EQ(reasonOf(record.toShow().payloads[0]), "no result in time");
}

TEST(FrameRecord, FillsInNothingWhenComplete) {
  FrameRecord record(listOf(1, 1));
  answers(record, 0, failure("broken"));
  EXPECT_THAT(record.fillIn({}), IsEmpty());
  EXPECT_EQ(reasonOf(record.toShow().payloads[0]), "broken");
}

TEST(FrameRecord, AcceptsALateResultForAMissingSlot) {
  const FrameRecord late = shownWithoutSecond(1, 5);
  FrameRecord shown = shownWithoutSecond(2, 6);
  EXPECT_FALSE(shown.takeStale(late, 1, failure("late and broken")));
  EXPECT_TRUE(shown.takeStale(late, 1, picture(7)));
  EXPECT_TRUE(shown.takeStale(shown, 1, picture(8))) << "its own, come late, in place of an older one";
  EXPECT_FALSE(shown.takeStale(late, 0, picture(9))) << "it has its own";
  FrameRecord next(listOf(3, 2));
  next.fillIn({&shown});
  EXPECT_EQ(colourOf(next.toShow().payloads[0]), 6U);
  EXPECT_EQ(colourOf(next.toShow().payloads[1]), 8U);
}

TEST(FrameRecord, RefusesLateResultsOfOtherSizesOrObjects) {
  FrameRecord shown = shownWithoutSecond(2, 6);
  EXPECT_FALSE(shown.takeStale(shownWithoutSecond(1, 5, 640), 1, picture(7)));
  EXPECT_FALSE(shown.takeStale(FrameRecord(listOf(1, 3)), 2, picture(7)));
}

TEST(FrameRecord, ReleasesPayloadsWhenDropped) {
  FrameRecord record(listOf(1, 1));
  answers(record, 0, picture(5));
  record.drop();
  EXPECT_EQ(record.state(), FrameRecord::State::kDropped);
  EXPECT_EQ(colourOf(record.toShow().payloads[0]), 0U);
}

}  // namespace
}  // namespace grove::node
