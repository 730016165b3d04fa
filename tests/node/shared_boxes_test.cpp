#include <gtest/gtest.h>

#include <chrono>
#include <thread>
#include <vector>

#include "eventually.h"
#include "node/nodes_fixture.h"

namespace grove::node {
namespace {

using namespace std::chrono_literals;
using testing::Screen;
using tests::eventually;

/// The same boxes, of whose colours each is shared data that frontend halves draw.
class SharedBoxes : public testing::Nodes {
 protected:
  SharedBoxes() : Nodes(testing::BoxAsks::kShared) {}

  /// Red in the middle, of the near box, once the frame is there.
  static std::uint32_t nearRed(Screen& screen, FrameNumber frame) {
    const auto image = screen.waitFor(frame);
    return image ? image->colourRow(90)[160] & 0xFFU : 0;
  }
};

TEST_P(SharedBoxes, AreDrawnByTheFrontend) {
  const auto screen = std::make_shared<Screen>(workers, timeline);
  const auto node = frontend(1, 0.0F, screen);
  ASSERT_TRUE(node->requestFrame());
  const auto image = screen->waitFor(1);
  ASSERT_TRUE(image);
  EXPECT_EQ(image->colourRow(90)[160] & 0xFFU, 90U) << "the near box hides the far one";
  EXPECT_EQ(image->colourRow(90)[154] & 0xFFU, 200U) << "which shows beside it";
  EXPECT_EQ(image->colourRow(5)[5], 0xFF000000U);
}

TEST_P(SharedBoxes, AreRequestedOnceForAllFramesOfAllVisitors) {
  std::vector<std::shared_ptr<Screen>> screens;
  std::vector<std::unique_ptr<FrontendNode>> nodes;
  for (std::uint32_t number = 1; number <= 8; ++number) {
    screens.push_back(std::make_shared<Screen>(workers, timeline));
    nodes.push_back(frontend(number, 0.0F, screens.back()));
  }
  for (FrameNumber frame = 1; frame <= 5; ++frame) {
    for (const auto& node : nodes) ASSERT_TRUE(eventually([&] { return node->requestFrame(); }));
    for (const auto& screen : screens) ASSERT_EQ(nearRed(*screen, frame), 90U);
  }
  EXPECT_EQ(transport.requests, 2) << "one for each box";
  EXPECT_EQ(process.shared().statistics().entries, 2U);
}

TEST_P(SharedBoxes, AnnouncedChangesAreShownSoon) {
  const auto screen = std::make_shared<Screen>(workers, timeline);
  const auto node = frontend(1, 0.0F, screen);
  FrameNumber frame = 0;
  const auto shows = [&](std::uint32_t red) { return node->requestFrame() && nearRed(*screen, ++frame) == red; };
  ASSERT_TRUE(eventually([&] { return shows(90); }));
  controls->version = 11;
  for (const world::Object& object : scene.layout.objects) controls->announce({{object.id, {}}, 11});
  EXPECT_TRUE(eventually([&] { return shows(100); }));
}

/// Or a half would answer with differences where nobody unpacks them.
TEST_P(SharedBoxes, KnownVersionsAreSentOnlyOverTheWire) {
  const auto screen = std::make_shared<Screen>(workers, timeline);
  const auto node = frontend(1, 0.0F, screen);
  for (FrameNumber frame = 1; frame <= 2; ++frame) {
    ASSERT_TRUE(eventually([&] { return node->requestFrame(); }));
    ASSERT_EQ(nearRed(*screen, frame), 90U);
  }
  controls->version = 11;
  controls->announce({{scene.layout.objects[1].id, {}}, 11});
  ASSERT_TRUE(eventually([&] { return controls->answered == 3; }));
  EXPECT_EQ(controls->known, transport.sharesMemory() ? 0U : 1U);
}

TEST_P(SharedBoxes, FailureLeavesThemOut) {
  const auto screen = std::make_shared<Screen>(workers, timeline);
  const auto node = frontend(1, 0.0F, screen);
  controls->fail = true;
  ASSERT_TRUE(node->requestFrame());
  EXPECT_EQ(nearRed(*screen, 1), 0U);
  controls->fail = false;
  ASSERT_TRUE(eventually([&] { return node->requestFrame(); }));
  EXPECT_EQ(nearRed(*screen, 2), 90U);
}

TEST_P(SharedBoxes, ExceptionCostsOneObjectInOneFrame) {
  using Fault = testing::FaultyTransport::Fault;
  for (const Fault fault : {Fault::kSendRequest, Fault::kCompress, Fault::kSendResult, Fault::kDecompress}) {
    // A process of its own has nothing yet.
    FrontendProcess fresh(2, scene.layout, frontends, transport, {workers, timeline, memory, images, layout.sky}, 0);
    const auto screen = std::make_shared<Screen>(workers, timeline);
    FrontendNode node(
        makeId(2, 1), FramePolicy{1, deadlineSeconds},
        [](FrameNumber frame) {
          View view;
          view.session = makeId(2, 1);
          view.frame = frame;
          view.camera.width = 320;
          view.camera.height = 180;
          return view;
        },
        screen, {}, fresh);
    transport.next = fault;
    ASSERT_TRUE(node.requestFrame());
    const auto with = screen->waitFor(1);
    ASSERT_TRUE(with) << "fault " << static_cast<int>(fault);
    EXPECT_EQ(transport.next, Fault::kNone) << "it has happened";
    const bool near = (with->colourRow(90)[160] & 0xFFU) == 90U;
    const bool far = (with->colourRow(90)[154] & 0xFFU) == 200U;
    EXPECT_NE(near, far) << "fault " << static_cast<int>(fault) << ": one of two is missing";
    ASSERT_TRUE(eventually([&] { return node.requestFrame(); }));
    const auto after = screen->waitFor(2);
    ASSERT_TRUE(after);
    EXPECT_EQ(after->colourRow(90)[160] & 0xFFU, 90U);
    EXPECT_EQ(after->colourRow(90)[154] & 0xFFU, 200U);
  }
}

TEST_P(SharedBoxes, RoundTripAsBytes) {
  const auto made = std::make_shared<const testing::BoxColour>(7, 0xFF123456U);
  Result result;
  result.what = {scene.layout.objects[0].id, {}};
  result.shared = true;
  result.version = 7;
  result.packed = made->packed(timeline, "box");
  process.unpack(result);
  const auto& data = std::get<std::shared_ptr<const SharedData>>(result.payload);
  EXPECT_EQ(static_cast<const testing::BoxColour&>(*data).colour(), 0xFF123456U);
  EXPECT_EQ(data->version(), 7U);
  EXPECT_EQ(frontendMemory.totals().at({"shared store", "box"}).bytes, static_cast<std::int64_t>(data->bytes()));
  result.what.object = 99;
  result.packed = made->packed(timeline, "box");
  EXPECT_THROW(process.unpack(result), PackingError);
}

/// Would catch a backend node that fills a process's memory.
TEST_P(SharedBoxes, UnrequestedDataIsCountedAndDropped) {
  const auto made = std::make_shared<const testing::BoxColour>(7, 0xFF123456U);
  for (const Key& key : {Key(), Key("other")}) {
    Result result;
    result.session = makeId(1, 0);
    result.what = {scene.layout.objects[0].id, key};
    result.shared = true;
    result.version = 7;
    result.packed = made->packed(timeline, "box");
    process.receive(ToFrontend(std::move(result)));
  }
  EXPECT_TRUE(eventually([&] { return timeline.counters()["unrequested shared data"] == 2; }));
  EXPECT_EQ(process.shared().statistics().entries, 0U);
}

INSTANTIATE_TEST_SUITE_P(OverEach, SharedBoxes, testing::kAllTransports, testing::transportName);

}  // namespace
}  // namespace grove::node
