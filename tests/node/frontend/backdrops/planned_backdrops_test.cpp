#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "node/frontend/planner_stand.h"
#include "node/frontend/scene_analyzer.h"

/// The Frame Planner with backdrops: the order in which frames are shown.
namespace grove::node {
namespace {

using testing::colourOf;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using testing::listOf;
using testing::picture;

/// Of the only object.
constexpr world::Rect kMiddle{160, 90, 161, 91};

class PlannedBackdrops : public testing::PlannerStand {
 protected:
  PlannedBackdrops() {
    layout.objects.push_back(testing::objectOf(1, {{-1.0F, 1.0F, -11.0F}, {1.0F, 2.0F, -10.0F}}));
    stillness = [](const VisibleObject&) { return 10.0F; };
  }
  void beginFrame(FrameNumber number, double deadline = std::numeric_limits<double>::infinity()) {
    auto view = std::make_shared<View>();
    view->session = 1;
    view->frame = number;
    view->camera.width = 320;
    view->camera.height = 180;
    view->time = static_cast<double>(number) / 30.0;
    view->deadline = deadline;
    auto list = std::make_shared<FrameList>();
    list->objects = visibleObjects(layout, *view);
    list->view = std::move(view);
    begin(std::move(list));
  }
};

/// Fails if a frame that asks for nothing overtakes the one whose backdrop it shows.
TEST_F(PlannedBackdrops, AFrameWaitsForItsBackdrop) {
  beginFrame(1);
  beginFrame(2);
  EXPECT_THAT(shownNumbers(), IsEmpty());
  EXPECT_EQ(backend.requests().size(), 1U) << "the second asks for nothing";
  answer(1, 0, picture(5, kMiddle));
  EXPECT_THAT(shownNumbers(), ElementsAre(1, 2));
  const auto frames = shown->frames();
  EXPECT_TRUE(frames[0].list->drawsBackdrop());
  EXPECT_EQ(frames[1].list->backdrop, 1U);
  EXPECT_TRUE(frames[1].payloads.empty());
  EXPECT_EQ(dropped, 0);
}

TEST_F(PlannedBackdrops, OverdueBackdropIsShownBeforeItsDependents) {
  beginFrame(1, 0.0);
  beginFrame(2, 0.0);
  checkDeadline();
  EXPECT_THAT(shownNumbers(), ElementsAre(1, 2));
  EXPECT_EQ(dropped, 0);
}

/// Fails if what is drawn next has no last results, because the frames in between had none of still objects.
TEST_F(PlannedBackdrops, OverdueBackdropUsesLastResults) {
  beginFrame(1);
  answer(1, 0, picture(5, kMiddle));
  beginFrame(2);
  beginFrame(40, 0.0);
  checkDeadline();
  ASSERT_THAT(shownNumbers(), ElementsAre(1, 2, 40));
  EXPECT_EQ(colourOf(newestPayloads().at(0)), 5U);
}

/// Fails if what is added to a backdrop is asked for as the frame sees it, or what is shown over it as the backdrop
/// does.
TEST_F(PlannedBackdrops, ExtensionsUseTheBackdropEye) {
  auto list = std::make_shared<FrameList>(*listOf(2, 2));
  list->backdrop = 2;
  list->eye = listOf(1, 0)->view;
  list->objects.front().still = true;
  const auto unplanned = std::make_shared<FramePlanner>(64, process, halves, nullptr, [] {});
  unplanned->connect(shown);
  ASSERT_EQ(unplanned->push(std::shared_ptr<const FrameList>(list)), pipeline::PushResult::kAccepted);
  ASSERT_TRUE(tests::eventually([&] { return unplanned->idle(); }));
  ASSERT_EQ(backend.requests().size(), 2U);
  EXPECT_EQ(backend.requests()[0].eye, list->eye);
  EXPECT_EQ(&backend.requests()[0].seenBy(), list->eye.get());
  EXPECT_EQ(backend.requests()[1].eye, nullptr);
  EXPECT_EQ(&backend.requests()[1].seenBy(), list->view.get());
  unplanned->close();
}

TEST_F(PlannedBackdrops, LateBackdropResultsServeTheNext) {
  beginFrame(1, 0.0);
  checkDeadline();
  beginFrame(2);
  answer(1, 0, picture(7, kMiddle));
  beginFrame(40, 0.0);
  checkDeadline();
  EXPECT_EQ(colourOf(newestPayloads().at(0)), 7U);
}

}  // namespace
}  // namespace grove::node
