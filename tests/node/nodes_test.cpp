#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <thread>

#include "eventually.h"
#include "node/messages/packing/picture_packing.h"
#include "node/nodes_fixture.h"
#include "pipeline/clocks.h"

namespace grove::node {
namespace {

using namespace std::chrono_literals;
using testing::Nodes;
using testing::Screen;
using tests::eventually;

TEST_P(Nodes, FrameCompletes) {
  const auto screen = std::make_shared<Screen>(workers, timeline);
  const auto node = frontend(1, 0.0F, screen);
  ASSERT_TRUE(node->requestFrame());
  const auto image = screen->waitFor(1);
  ASSERT_TRUE(image);
  EXPECT_EQ(image->colourRow(90)[160] & 0xFFU, 90u) << "the near box hides the far one";
  EXPECT_EQ(image->colourRow(90)[154] & 0xFFU, 200u) << "which shows beside it";
  EXPECT_EQ(image->colourRow(5)[5], 0xFF000000U);
  // A frame may be shown before the thread that sent its requests has ended its stage.
  for (const char* box : {"Scene Analyzer", "Frame Planner", "Request Receiver", "Renderer", "Compressor",
                          "Result Sender", "Result Receiver", "Decompressor", "Compositor"}) {
    EXPECT_TRUE(eventually([&] { return timeline.totals().contains(box); })) << box;
  }
}

TEST_P(Nodes, UnrequestedPicturesAreNotUnpacked) {
  Result result;
  result.session = 1;
  result.frame = 1;
  result.packed = std::make_shared<const PackedBytes>(packPicture(*images.acquire({0, 0, 32, 32})));
  EXPECT_THROW(process.unpack(result), PackingError);
}

TEST_P(Nodes, FramesInFlightStayInOrder) {
  const auto screen = std::make_shared<Screen>(workers, timeline);
  const auto node = frontend(1, 0.0F, screen, 4);
  FrameNumber asked = 0;
  while (asked < 200) {
    if (node->requestFrame()) {
      ++asked;
    } else {
      std::this_thread::sleep_for(100us);
    }
  }
  ASSERT_TRUE(screen->waitFor(200));
  const auto order = screen->order();
  EXPECT_TRUE(std::ranges::is_sorted(order));
  EXPECT_EQ(std::ranges::adjacent_find(order), order.end());
  // Only a frame that a newer one has overtaken is left out: at most those in flight beside it.
  for (std::size_t i = 1; i < order.size(); ++i) EXPECT_LE(order[i] - order[i - 1], 4u);
  EXPECT_TRUE(eventually([&] { return ended == 200; })) << ended;
}

TEST_P(Nodes, FramesInFlightAreBounded) {
  for (const int max : {1, 3}) {
    const auto screen = std::make_shared<Screen>(workers, timeline);
    transport.keepBack = true;
    const auto node = frontend(static_cast<std::uint32_t>(max), 0.0F, screen, max);
    int started = 0;
    for (int i = 0; i < 50; ++i) started += node->requestFrame() ? 1 : 0;
    EXPECT_EQ(started, max);
    EXPECT_TRUE(node->full());
    EXPECT_TRUE(eventually([&] { return controls->answered >= 2 * max; })) << "all are made";
    EXPECT_FALSE(node->requestFrame()) << "and none has ended";
    transport.release();
    ASSERT_TRUE(screen->waitFor(static_cast<FrameNumber>(max)));
    EXPECT_TRUE(eventually([&] { return !node->full(); }));
  }
}

TEST_P(Nodes, LostResultShowsTheLastOne) {
  deadlineSeconds = 0.2;
  const auto screen = std::make_shared<Screen>(workers, timeline);
  const auto node = frontend(1, 0.0F, screen, 1);
  ASSERT_TRUE(node->requestFrame());
  ASSERT_TRUE(screen->waitFor(1));
  ASSERT_TRUE(eventually([&] { return node->requestFrame(); }));
  ASSERT_TRUE(screen->waitFor(2));
  transport.keepBack = true;
  ASSERT_TRUE(eventually([&] { return node->requestFrame(); }));
  ASSERT_TRUE(eventually([&] {
    node->checkDeadline();
    return screen->waitFor(3, 1ms) != nullptr;
  }));
  const auto image = screen->waitFor(3);
  EXPECT_EQ(image->colourRow(90)[160] & 0xFFU, 90u) << "the near box, as it was";
  EXPECT_EQ(timeline.totals().at("Frame Planner").failures, 2u);
  EXPECT_TRUE(eventually([&] { return !node->full(); })) << "its place is free again";
  transport.release();
  EXPECT_TRUE(eventually([&] { return timeline.counters()["late results"] == 2; }));
}

TEST_P(Nodes, SkipsObjectsWithoutAnswerAfterTheDeadline) {
  deadlineSeconds = 0.05;
  const auto screen = std::make_shared<Screen>(workers, timeline);
  const auto node = frontend(1, 0.0F, screen, 1);
  transport.keepBack = true;
  ASSERT_TRUE(node->requestFrame());
  ASSERT_TRUE(eventually([&] {
    node->checkDeadline();
    return screen->waitFor(1, 1ms) != nullptr;
  }));
  EXPECT_EQ(screen->waitFor(1)->colourRow(90)[160], 0xFF000000U);
}

TEST_P(Nodes, LateObjectShowsItsLastAnswer) {
  deadlineSeconds = 0.05;
  const auto screen = std::make_shared<Screen>(workers, timeline);
  const auto node = frontend(1, 0.0F, screen, 1);
  const auto showWithoutResults = [&](FrameNumber frame) {
    transport.keepBack = true;
    return eventually([&] { return node->requestFrame(); }) && eventually([&] {
             node->checkDeadline();
             return screen->waitFor(frame, 1ms) != nullptr;
           });
  };
  ASSERT_TRUE(showWithoutResults(1));
  ASSERT_TRUE(eventually([&] { return transport.kept() == 2; }));
  transport.release();
  ASSERT_TRUE(eventually([&] { return timeline.counters()["late results kept for the next frame"] == 2; }));
  ASSERT_TRUE(showWithoutResults(2));
  EXPECT_EQ(screen->waitFor(2)->colourRow(90)[160] & 0xFFU, 90U) << "the near box came too late for frame 1";
  EXPECT_EQ(screen->waitFor(2)->colourRow(90)[154] & 0xFFU, 200U);
}

TEST_P(Nodes, ClosingNodeEndsEveryFrameOnce) {
  for (int i = 0; i < 50; ++i) {
    ended = 0;
    const auto screen = std::make_shared<Screen>(workers, timeline);
    auto node = frontend(1, 0.0F, screen, 4);
    int began = 0;
    for (int k = 0; k < 4; ++k) began += node->requestFrame() ? 1 : 0;
    if (i % 2 == 0) std::this_thread::sleep_for(50us * i);
    node->close();
    EXPECT_FALSE(node->requestFrame());
    node.reset();
    workers.drain();
    ASSERT_EQ(ended, began);
  }
}

TEST_P(Nodes, ExceptionCostsOneObjectInOneFrame) {
  using Fault = testing::FaultyTransport::Fault;
  std::uint32_t number = 1;
  for (const Fault fault : {Fault::kSendRequest, Fault::kCompress, Fault::kSendResult, Fault::kDecompress}) {
    const auto screen = std::make_shared<Screen>(workers, timeline);
    const auto node = frontend(number++, 0.0F, screen, 1);
    transport.next = fault;
    ASSERT_TRUE(node->requestFrame());
    const auto with = screen->waitFor(1);
    ASSERT_TRUE(with) << "fault " << static_cast<int>(fault);
    EXPECT_EQ(transport.next, Fault::kNone) << "it has thrown";
    // The near box covers the middle, the far one what is beside it.
    const bool near = (with->colourRow(90)[160] & 0xFFU) == 90U;
    const bool far = (with->colourRow(90)[154] & 0xFFU) == 200U;
    EXPECT_NE(near, far) << "fault " << static_cast<int>(fault) << ": one of two is missing";
    ASSERT_TRUE(eventually([&] { return node->requestFrame(); }));
    const auto after = screen->waitFor(2);
    ASSERT_TRUE(after);
    EXPECT_EQ(after->colourRow(90)[160] & 0xFFU, 90U);
    EXPECT_EQ(after->colourRow(90)[154] & 0xFFU, 200U);
  }
}

TEST_P(Nodes, UnreachableObjectShowsItsLastAnswer) {
  using Fault = testing::FaultyTransport::Fault;
  const auto screen = std::make_shared<Screen>(workers, timeline);
  const auto node = frontend(1, 0.0F, screen, 1);
  ASSERT_TRUE(node->requestFrame());
  ASSERT_TRUE(screen->waitFor(1));
  transport.next = Fault::kSendRequest;
  ASSERT_TRUE(eventually([&] { return node->requestFrame(); }));
  const auto image = screen->waitFor(2);
  ASSERT_TRUE(image);
  EXPECT_EQ(transport.next, Fault::kNone) << "it was refused";
  EXPECT_EQ(image->colourRow(90)[160] & 0xFFU, 90U);
  EXPECT_EQ(image->colourRow(90)[154] & 0xFFU, 200U);
}

/// Or what it answers is taken for a difference to data of its earlier life.
TEST_P(Nodes, RestartedNodeIsRequestedAgain) {
  const world::ObjectId object = scene.objects[0].id;
  std::atomic<int> brought = 0;
  const auto get = [&] {
    Request request;
    auto view = std::make_shared<View>();
    view->session = makeId(kProcess, 1);
    view->frame = 1;
    view->deadline = pipeline::wallSeconds() + 60.0;
    request.view = std::move(view);
    request.object = object;
    request.shared = true;
    (void)process.send(request.view);
    process.shared().get(request, [&](const Payload&) { ++brought; });
  };
  get();
  ASSERT_TRUE(eventually([&] { return brought == 1; }));
  const int before = transport.requests;
  NodeWelcome welcome;
  welcome.epoch = backend.epoch() + 1;
  welcome.objects.emplace_back().id = object;
  process.receive(std::move(welcome));
  // The renewal waits for a worker.
  const auto isAsked = [&] {
    get();
    return transport.requests == before + 1;
  };
  ASSERT_TRUE(eventually(isAsked)) << "it is fetched anew";
  EXPECT_TRUE(eventually([&] { return process.shared().known({object, {}}) != nullptr; }));
}

TEST_P(Nodes, FailingBackendCostsOnlyItsObjects) {
  const auto screen = std::make_shared<Screen>(workers, timeline);
  const auto node = frontend(1, 0.0F, screen);
  controls->fail = true;
  ASSERT_TRUE(node->requestFrame());
  const auto without = screen->waitFor(1);
  ASSERT_TRUE(without);
  EXPECT_EQ(without->colourRow(90)[160], 0xFF000000U);
  controls->fail = false;
  while (!node->requestFrame()) std::this_thread::sleep_for(1ms);
  const auto with = screen->waitFor(2);
  ASSERT_TRUE(with);
  EXPECT_EQ(with->colourRow(90)[160] & 0xFFU, 90u);
}

TEST_P(Nodes, SessionsShareTheBackendAndSeeTheirOwnView) {
  const auto screenA = std::make_shared<Screen>(workers, timeline);
  const auto screenB = std::make_shared<Screen>(workers, timeline);
  const auto a = frontend(1, 0.0F, screenA);
  const auto b = frontend(2, 3.1F, screenB);
  ASSERT_TRUE(a->requestFrame());
  ASSERT_TRUE(b->requestFrame());
  const auto seenByA = screenA->waitFor(1);
  const auto seenByB = screenB->waitFor(1);
  ASSERT_TRUE(seenByA && seenByB);
  EXPECT_EQ(seenByA->colourRow(90)[160] & 0xFFU, 90u);
  EXPECT_EQ(seenByB->colourRow(90)[160], 0xFF000000U) << "looks the other way";
}

TEST_P(Nodes, ClosingWithFramesInFlightIsClean) {
  for (int i = 0; i < 20; ++i) {
    const auto screen = std::make_shared<Screen>(workers, timeline);
    const auto node = frontend(static_cast<std::uint32_t>(i) + 10, 0.0F, screen, 4);
    for (int k = 0; k < 4; ++k) node->requestFrame();
  }
  const auto screen = std::make_shared<Screen>(workers, timeline);
  const auto node = frontend(99, 0.0F, screen);
  ASSERT_TRUE(node->requestFrame());
  EXPECT_TRUE(screen->waitFor(1)) << "the backend still serves others";
}

INSTANTIATE_TEST_SUITE_P(OverEach, Nodes, testing::kAllTransports, testing::transportName);

}  // namespace
}  // namespace grove::node
