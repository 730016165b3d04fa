#include "node/frontend/frames/frame_planner.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

#include "node/frontend/planner_stand.h"
#include "pipeline/clocks.h"

namespace grove::node {
namespace {

using testing::colourOf;
using ::testing::ElementsAre;
using testing::failure;
using ::testing::IsEmpty;
using testing::listOf;
using testing::picture;
using testing::reasonOf;
using ::testing::SizeIs;

constexpr const char* kUnasked = "unrequested results";
constexpr const char* kLate = "late results";
constexpr const char* kOfUse = "late results kept for the next frame";

Ask pictureOf(const VisibleObject& object, const char* key = "") {
  return {.shared = false, .key = key, .rect = object.rect};
}

class FramePlanning : public testing::PlannerStand {
 protected:
  /// A frame that is overdue at the next look.
  void beginLate(FrameNumber number, std::size_t objects, int width = 320) {
    begin(listOf(number, objects, {.deadline = pipeline::wallSeconds(), .width = width}));
  }
};

TEST_F(FramePlanning, ShowsAFrameAfterAllAnswersInAnyOrder) {
  begin(listOf(1, 3));
  ASSERT_THAT(backend.requests(), SizeIs(3));
  EXPECT_EQ(backend.requests()[1].object, 2U);
  EXPECT_EQ(backend.requests()[1].slot, 1U);
  answer(1, 2, picture(3));
  answer(1, 0, picture(1));
  EXPECT_THAT(shownNumbers(), IsEmpty());
  answer(1, 1, picture(2));
  ASSERT_THAT(shownNumbers(), ElementsAre(1));
  for (std::uint32_t slot = 0; slot < 3; ++slot) EXPECT_EQ(colourOf(newestPayloads()[slot]), slot + 1);
  EXPECT_EQ(dropped, 0);
}

/// Would catch visitors whom no backend node draws, since views do not bring them.
TEST_F(FramePlanning, RequestsCarryTheShownVisitor) {
  View view;
  view.session = 1;
  view.frame = 1;
  for (const world::PlayerId id : {6U, 7U}) view.players.emplace_back().id = id;
  auto list = std::make_shared<FrameList>(*listOf(1, 3));
  list->objects[1].object.id = world::kFirstPlayerObject + 7;
  list->objects[2].object.id = world::kFirstPlayerObject + 8;
  list->view = std::make_shared<const View>(std::move(view));
  begin(std::move(list));
  const std::vector<Request> requests = backend.requests();
  ASSERT_THAT(requests, SizeIs(3));
  EXPECT_FALSE(requests[0].player);
  ASSERT_TRUE(requests[1].player);
  EXPECT_EQ(requests[1].player->id, 7U);
  EXPECT_FALSE(requests[2].player) << "the frame does not know him";
}

TEST_F(FramePlanning, ShowsAnEmptyFrameImmediately) {
  begin(listOf(1, 0));
  EXPECT_THAT(shownNumbers(), ElementsAre(1));
}

TEST_F(FramePlanning, CountsUnrequestedResults) {
  begin(listOf(1, 2));
  answer(2, 0, picture(1));
  answer(1, 2, picture(1));
  answer(1, 0, picture(1));
  answer(1, 0, picture(2));
  EXPECT_EQ(counted(kUnasked), 3U) << "of an unknown frame, of an unknown slot, and a second one";
  answer(1, 1, picture(3));
  EXPECT_EQ(colourOf(newestPayloads()[0]), 1U);
}

TEST_F(FramePlanning, DropsFramesOlderThanTheShown) {
  begin(listOf(1, 1));
  begin(listOf(2, 1));
  answer(2, 0, picture(2));
  answer(1, 0, picture(1));
  EXPECT_THAT(shownNumbers(), ElementsAre(2));
  EXPECT_EQ(dropped, 1);
}

TEST_F(FramePlanning, RefusedRequestFailsImmediately) {
  backend.full = true;
  begin(listOf(1, 1));
  ASSERT_THAT(shownNumbers(), ElementsAre(1));
  EXPECT_EQ(reasonOf(newestPayloads()[0]), "the backend node is full");
  EXPECT_TRUE(std::get<Failure>(newestPayloads()[0]).notNow);
}

TEST_F(FramePlanning, OversizedPictureFails) {
  begin(listOf(1, 1));
  answer(1, 0, picture(1, {0, 0, 9, 8}));
  ASSERT_THAT(shownNumbers(), ElementsAre(1));
  EXPECT_EQ(reasonOf(newestPayloads()[0]), "the picture is larger than requested");
}

TEST_F(FramePlanning, EndlessRequestsFail) {
  script = [](const VisibleObject& object, const Reply*) { return pictureOf(object); };
  begin(listOf(1, 1));
  for (int i = 0; i < 6; ++i) {
    EXPECT_THAT(shownNumbers(), IsEmpty());
    answer(1, 0, picture(1));
  }
  EXPECT_THAT(backend.requests(), SizeIs(6));
  ASSERT_THAT(shownNumbers(), ElementsAre(1));
  EXPECT_EQ(reasonOf(newestPayloads()[0]), "the object makes too many requests");
}

TEST_F(FramePlanning, EndlessRequestsFailEvenIfRefused) {
  script = [](const VisibleObject& object, const Reply*) { return pictureOf(object); };
  backend.full = true;
  begin(listOf(1, 1));
  ASSERT_THAT(shownNumbers(), ElementsAre(1));
  EXPECT_EQ(reasonOf(newestPayloads()[0]), "the object makes too many requests");
}

TEST_F(FramePlanning, ThrowingPlanCostsItsObject) {
  script = [](const VisibleObject& object, const Reply*) -> Plan {
    if (object.object.id == 1) throw std::runtime_error("the half is broken");
    return picture(2);
  };
  begin(listOf(1, 2));
  ASSERT_THAT(shownNumbers(), ElementsAre(1));
  EXPECT_EQ(reasonOf(newestPayloads()[0]), "the half is broken");
  EXPECT_EQ(colourOf(newestPayloads()[1]), 2U);
}

TEST_F(FramePlanning, SharedDataReturnsToThePlan) {
  script = [](const VisibleObject&, const Reply* reply) -> Plan {
    if (reply != nullptr) return reply->payload;
    return Ask{.shared = true, .key = "k", .rect = {}};
  };
  begin(listOf(1, 2));
  ASSERT_THAT(backend.requests(), SizeIs(2));
  for (const Request& request : backend.requests()) {
    EXPECT_TRUE(process.shared().put(resultOf(request, failure("none"))));
  }
  settle();
  ASSERT_THAT(shownNumbers(), ElementsAre(1));
  EXPECT_EQ(reasonOf(newestPayloads()[1]), "none");
}

TEST_F(FramePlanning, ShowsAnOverdueFramePartially) {
  beginLate(1, 2);
  answer(1, 1, picture(5));
  EXPECT_THAT(shownNumbers(), IsEmpty());
  checkDeadline();
  ASSERT_THAT(shownNumbers(), ElementsAre(1));
  EXPECT_EQ(reasonOf(newestPayloads()[0]), "no result in time");
  EXPECT_EQ(colourOf(newestPayloads()[1]), 5U);
  EXPECT_EQ(timeline.totals().at("Frame Planner").failures, 1U) << "one for each slot";
  EXPECT_THAT(backend.cancelled(), ElementsAre(1));
  checkDeadline();
  EXPECT_THAT(shownNumbers(), ElementsAre(1)) << "it has ended";
}

TEST_F(FramePlanning, LeavesFramesBeforeTheirDeadline) {
  begin(listOf(1, 1, {.deadline = pipeline::wallSeconds() + 1000.0}));
  checkDeadline();
  EXPECT_THAT(shownNumbers(), IsEmpty());
  EXPECT_THAT(backend.cancelled(), IsEmpty());
}

TEST_F(FramePlanning, ShowsTheNewestOverdueFrame) {
  beginLate(1, 1);
  beginLate(2, 1);
  beginLate(3, 1);
  checkDeadline();
  EXPECT_THAT(shownNumbers(), ElementsAre(3));
  EXPECT_EQ(dropped, 2);
  EXPECT_THAT(backend.cancelled(), ElementsAre(3));
}

TEST_F(FramePlanning, DropsOverdueFramesOlderThanTheShown) {
  beginLate(1, 1);
  begin(listOf(2, 1));
  answer(2, 0, picture(2));
  checkDeadline();
  EXPECT_THAT(shownNumbers(), ElementsAre(2));
  EXPECT_EQ(dropped, 1);
  EXPECT_THAT(backend.cancelled(), ElementsAre(1));
}

TEST_F(FramePlanning, MissingResultsUseTheLastOnes) {
  begin(listOf(1, 1));
  answer(1, 0, picture(5));
  beginLate(2, 1);
  checkDeadline();
  EXPECT_EQ(colourOf(newestPayloads()[0]), 5U);
  beginLate(3, 1);
  checkDeadline();
  EXPECT_EQ(colourOf(newestPayloads()[0]), 5U) << "again and again";
  beginLate(4, 1, 640);
  checkDeadline();
  EXPECT_EQ(reasonOf(newestPayloads()[0]), "no result in time") << "but not in another size";
}

TEST_F(FramePlanning, LateResultsAreShownNext) {
  beginLate(1, 2);
  checkDeadline();
  answer(1, 0, picture(5));
  answer(1, 1, failure("broken"));
  answer(1, 0, picture(6));
  EXPECT_EQ(counted(kLate), 2U);
  EXPECT_EQ(counted(kOfUse), 1U);
  EXPECT_EQ(counted(kUnasked), 1U) << "an answer is late once";
  beginLate(2, 2);
  checkDeadline();
  EXPECT_EQ(colourOf(newestPayloads()[0]), 5U);
  EXPECT_EQ(reasonOf(newestPayloads()[1]), "no result in time");
}

TEST_F(FramePlanning, LateResultsAreDroppedAfterNewerAnswers) {
  beginLate(1, 1);
  checkDeadline();
  begin(listOf(2, 1));
  answer(2, 0, picture(6));
  answer(1, 0, picture(5));
  EXPECT_EQ(counted(kLate), 1U);
  EXPECT_EQ(counted(kOfUse), 0U);
  beginLate(3, 1);
  checkDeadline();
  EXPECT_EQ(colourOf(newestPayloads()[0]), 6U);
}

TEST_F(FramePlanning, LateResultsContinueTheirPlan) {
  script = [](const VisibleObject& object, const Reply* reply) -> Plan {
    if (reply != nullptr && reply->ask.key == "second") return reply->payload;
    return pictureOf(object, reply == nullptr ? "first" : "second");
  };
  beginLate(1, 1);
  checkDeadline();
  answer(1, 0, picture(4));
  ASSERT_THAT(backend.requests(), SizeIs(2));
  EXPECT_EQ(backend.requests()[1].key, "second");
  EXPECT_EQ(counted(kLate), 0U);
  answer(1, 0, picture(5));
  EXPECT_EQ(counted(kOfUse), 1U);
}

TEST_F(FramePlanning, ForgetsOldFrames) {
  beginLate(1, 1);
  checkDeadline();
  for (FrameNumber number = 2; number < 2 + FrameRecords::kKept; ++number) begin(listOf(number, 0));
  answer(1, 0, picture(5));
  EXPECT_EQ(counted(kUnasked), 1U);
}

TEST_F(FramePlanning, WaitsForTheNextStage) {
  begin(listOf(1, 1));
  shown->hold();
  Result result;
  result.frame = 1;
  result.payload = picture(5);
  ASSERT_EQ(planner->push(std::move(result)), pipeline::PushResult::kAccepted);
  workers.drain();
  EXPECT_EQ(planner->queued(), 1U);
  EXPECT_THAT(shownNumbers(), IsEmpty());
  shown->release();
  settle();
  EXPECT_THAT(shownNumbers(), ElementsAre(1));
}

}  // namespace
}  // namespace grove::node
