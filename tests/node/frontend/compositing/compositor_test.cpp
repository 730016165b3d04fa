#include "node/frontend/compositing/compositor.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <functional>
#include <mutex>
#include <stdexcept>

#include "eventually.h"
#include "node/frontend/frame_lists.h"
#include "node/limits.h"
#include "node/transport/reference_transport.h"
#include "pipeline/worker_pool.h"
#include "yuv_pictures.h"

namespace grove::node {
namespace {

using ::testing::ElementsAre;
using testing::listOf;
using testing::picture;

/// Notes the depth of a pixel far from its object's box, and has a name.
class LookingLayer final : public Layer {
 public:
  LookingLayer(world::ObjectId object, std::atomic<float>& depth) : object_(object), depth_(depth) {}
  void draw(raster::Image& frame) override { depth_ = frame.depthRow(10)[300]; }
  [[nodiscard]] world::Rect reach(const world::Rect& /*rect*/) const override { return {296, 8, 304, 16}; }
  [[nodiscard]] std::optional<Label> label(const raster::Image& /*frame*/) const override {
    // Every third is hidden; two of a depth each.
    if (object_ % 3 == 0) return std::nullopt;
    const world::ObjectId step = object_ / 2;
    return Label{.object = object_, .depth = static_cast<float>(100 - step)};
  }

  [[nodiscard]] std::optional<Mover> mover() const override {
    if (object_ % 3 == 0) return std::nullopt;
    return Mover{{0, 0, 1, 1}, 1.0F / static_cast<float>(object_), 2.0F, {1.0F, 0.0F, 0.0F}};
  }

 private:
  const world::ObjectId object_;
  std::atomic<float>& depth_;
};

/// Draws nothing, or throws where it would.
class BreakableHalf final : public FrontendHalf {
 public:
  BreakableHalf(const std::atomic<bool>& broken, std::atomic<float>& depth) : broken_(broken), depth_(depth) {}
  [[nodiscard]] std::unique_ptr<Layer> layer(const VisibleObject& object, const Payload&, const View&) override {
    if (broken_) throw std::runtime_error("the layer is broken");
    return object.still ? nullptr : std::make_unique<LookingLayer>(object.object.id, depth_);
  }

 private:
  const std::atomic<bool>& broken_;
  std::atomic<float>& depth_;
};

class BreakableType final : public FrontendType {
 public:
  BreakableType(const std::atomic<bool>& broken, std::atomic<float>& depth) : broken_(broken), depth_(depth) {}
  [[nodiscard]] std::string_view name() const override { return "breakable"; }
  [[nodiscard]] std::unique_ptr<FrontendHalf> makeHalf(const FrontendTools&) const override {
    return std::make_unique<BreakableHalf>(broken_, depth_);
  }

 private:
  const std::atomic<bool>& broken_;
  std::atomic<float>& depth_;
};

/// Keeps the frames that are shown.
class Frames final : public pipeline::Inlet<FinishedFrame> {
 public:
  pipeline::PushResult push(FinishedFrame frame) override {
    const std::lock_guard lock(mutex_);
    frames_.push_back(std::move(frame));
    return pipeline::PushResult::kAccepted;
  }
  bool tryReserve(std::function<void()>) override { return true; }
  void cancelReservation() override {}
  pipeline::PushResult pushReserved(FinishedFrame frame) override { return push(std::move(frame)); }
  [[nodiscard]] std::vector<FrameNumber> numbers() const {
    const std::lock_guard lock(mutex_);
    std::vector<FrameNumber> numbers;
    for (const FinishedFrame& frame : frames_) numbers.push_back(frame.view->frame);
    return numbers;
  }
  [[nodiscard]] std::shared_ptr<const raster::Image> newest() const {
    const std::lock_guard lock(mutex_);
    return tests::rgbaOf(*frames_.back().picture);
  }
  [[nodiscard]] std::shared_ptr<const CellNearness> nearness() const {
    const std::lock_guard lock(mutex_);
    return frames_.back().nearness;
  }
  [[nodiscard]] std::vector<Label> labels() const {
    const std::lock_guard lock(mutex_);
    return frames_.back().labels;
  }
  [[nodiscard]] std::vector<Mover> movers() const {
    const std::lock_guard lock(mutex_);
    return frames_.back().movers;
  }

 private:
  mutable std::mutex mutex_;
  std::vector<FinishedFrame> frames_;
};

class CompositorTest : public ::testing::Test {
 public:
  CompositorTest() { compositor->connect(shown); }
  ~CompositorTest() override {
    compositor->close();
    workers.drain();
  }

 protected:
  void show(CompleteFrame frame) {
    ASSERT_EQ(compositor->push(std::move(frame)), pipeline::PushResult::kAccepted);
    ASSERT_TRUE(tests::eventually([&] { return compositor->idle(); }));
  }

  std::atomic<bool> broken{false};
  std::atomic<float> depthSeen{0.0F};  ///< by the newest LookingLayer
  std::atomic<int> done{0};
  world::Layout layout = [] {
    world::Layout made;
    made.types = {"breakable"};
    return made;
  }();
  FrontendTypes types = [this] {
    FrontendTypes made;
    made.add(std::make_unique<BreakableType>(broken, depthSeen));
    return made;
  }();
  pipeline::Timeline timeline;
  pipeline::MemoryLedger memory;
  raster::ImagePool images;
  pipeline::WorkerPool workers{2};
  ReferenceTransport transport;
  FrontendProcess process{1, layout, types, transport, {workers, timeline, memory, images, layout.sky}, 0};
  RedrawTurns turns{2};
  const std::shared_ptr<BackdropStore> backdrops = std::make_shared<BackdropStore>(turns);
  const std::shared_ptr<Frames> shown = std::make_shared<Frames>();
  const std::shared_ptr<Compositor> compositor =
      std::make_shared<Compositor>(1, process, std::make_shared<VisitorHalves>(process), backdrops, [this] { ++done; });
};

TEST_F(CompositorTest, EndsEveryFrameOnceDespiteExceptions) {
  for (FrameNumber frame = 1; frame <= 3; ++frame) {
    broken = frame == 2;
    show({listOf(frame, 1), {picture(5)}});
    EXPECT_EQ(done, static_cast<int>(frame));
  }
  EXPECT_THAT(shown->numbers(), ElementsAre(1, 3));
  EXPECT_EQ(timeline.totals().at("Compositor").failures, 1U);
}

// Faults: names of what is hidden; those of the farthest where there are too many; an order that changes by itself.
TEST_F(CompositorTest, CollectsTheNamesOfTheNearest) {
  const auto list = listOf(1, 60);
  std::vector<Payload> payloads;
  for (std::size_t i = 0; i < list->objects.size(); ++i) payloads.push_back(picture(5));
  show({list, std::move(payloads)});
  const std::vector<Label> labels = shown->labels();
  ASSERT_EQ(labels.size(), kMaxLabelsPerFrame);
  const auto before = [](const Label& a, const Label& b) {
    return a.depth < b.depth || (a.depth == b.depth && a.object < b.object);
  };
  EXPECT_TRUE(std::ranges::is_sorted(labels, before));
  for (const Label& label : labels) EXPECT_NE(label.object % 3, 0U);
  EXPECT_EQ(labels.front().object, 58U);
  EXPECT_EQ(std::ranges::min(labels, {}, &Label::object).object, 25U) << "the others are farther, or hidden";
}

// Faults: more movers than a message has room for; those of the farthest.
TEST_F(CompositorTest, CollectsTheNearestMovers) {
  const auto list = listOf(1, 60);
  show({list, std::vector<Payload>(list->objects.size(), picture(5))});
  const std::vector<Mover> movers = shown->movers();
  ASSERT_EQ(movers.size(), kMaxMoversPerFrame);
  EXPECT_TRUE(std::ranges::is_sorted(movers, {}, &Mover::nearest));
  EXPECT_FLOAT_EQ(movers.front().nearest, 1.0F / 59.0F);
}

/// With a backdrop that reaches beyond its frame.
class CompositorBackdrops : public CompositorTest {
 protected:
  static constexpr std::uint32_t kStill = 0xFF808080U;
  static constexpr std::uint32_t kMoving = 0xFF303030U;

  /// A still picture and one that moves, each of one depth; without `still` the backdrop of frame 1 is shown.
  static CompleteFrame frameOf(FrameNumber number, float movingDepth, bool still) {
    auto list = std::make_shared<FrameList>(*listOf(number, still ? 2 : 1));
    list->backdrop = 1;
    list->area = {-8, -8, 336, 184};
    list->drawn = {list->area};
    const world::Rect rect{100, 50, 140, 90};
    list->objects.back().rect = rect;
    std::vector<Payload> payloads;
    if (still) {
      list->objects.front().still = true;
      payloads.push_back(flat(kStill, 5.0F, list->area));
    }
    payloads.push_back(flat(kMoving, movingDepth, rect));
    return {std::move(list), std::move(payloads)};
  }
  /// Its eye sees 64 pixels more on the right, which only another picture shows.
  [[nodiscard]] CompleteFrame extendedBy(FrameNumber number) const {
    auto list = std::make_shared<FrameList>(*listOf(number, 1));
    list->backdrop = number;
    list->area = {-8, -8, 400, 184};
    list->drawn = {{336, -8, 400, 184}};
    list->extended = backdrops->newest()->origin().frame;
    list->eye = backdrops->newest()->origin().view;
    list->objects.front().still = true;
    list->objects.front().rect = list->drawn.front();
    return {list, {flat(kMoving, 4.0F, list->drawn.front())}};
  }
  [[nodiscard]] std::uint32_t at(int x, int y) const { return shown->newest()->colourRow(y)[x]; }

  static Payload flat(std::uint32_t colour, float depth, const world::Rect& rect) {
    const auto image = raster::ImagePool().acquire(rect);
    std::ranges::fill(image->colour, colour);
    std::ranges::fill(image->depth, depth);
    return std::shared_ptr<const raster::Image>(image);
  }
};

TEST_F(CompositorBackdrops, ReusesStillObjectsAndDrawsOthersByDepth) {
  show(frameOf(1, 2.0F, true));
  ASSERT_TRUE(backdrops->newest());
  EXPECT_EQ(backdrops->newest()->image().rect, (world::Rect{-8, -8, 336, 184}));
  for (const FrameNumber frame : {1U, 2U, 3U}) {
    if (frame > 1) show(frameOf(frame, 2.0F, false));
    EXPECT_EQ(at(0, 0), kStill) << frame;
    EXPECT_EQ(at(319, 179), kStill) << frame;
    EXPECT_EQ(at(120, 70), kMoving) << frame;
  }
  show(frameOf(4, 9.0F, false));
  EXPECT_EQ(at(120, 70), kStill) << "it is behind the backdrop";
}

/// Fails if smoke and names are hidden by depths that were never written.
TEST_F(CompositorBackdrops, LayersMayReadDepthOutsideOfTheirBoxes) {
  for (const FrameNumber frame : {1U, 2U}) {
    depthSeen = 0.0F;
    show(frameOf(frame, 2.0F, frame == 1));
    EXPECT_NEAR(depthSeen, 5.0F, 0.001F) << frame;
  }
}

// Faults: a figure that is as far as what it covers; a strip without nearness; a frame without backdrop that has none.
TEST_F(CompositorBackdrops, TellsTheNearnessOfWhatItShows) {
  const auto expectCells = [&](float still, FrameNumber frame) {
    const auto nearness = shown->nearness();
    ASSERT_TRUE(nearness);
    ASSERT_EQ(nearness->across(), 40);
    ASSERT_EQ(nearness->down(), 23);
    for (int row = 0; row < nearness->down(); ++row) {
      for (int column = 0; column < nearness->across(); ++column) {
        const bool moving = column >= 12 && column <= 17 && row >= 6 && row <= 10;
        ASSERT_NEAR(nearness->row(row)[static_cast<std::size_t>(column)], moving ? 0.5F : still, 1.0e-4F)
            << column << ", " << row << " of frame " << frame;
      }
    }
  };
  for (const FrameNumber frame : {1U, 2U}) {
    show(frameOf(frame, 2.0F, frame == 1));
    expectCells(0.2F, frame);
  }
  CompleteFrame whole = frameOf(3, 2.0F, false);
  auto list = std::make_shared<FrameList>(*whole.list);
  list->backdrop.reset();
  list->area = {};
  list->drawn.clear();
  whole.list = std::move(list);
  show(std::move(whole));
  expectCells(0.0F, 3);
}

/// Fails if what a backdrop had is lost, drawn anew or moved, and if its eye becomes that of the frame.
TEST_F(CompositorBackdrops, ExtensionKeepsOldPixels) {
  show(frameOf(1, 2.0F, true));
  const auto before = backdrops->newest();
  show(extendedBy(2));
  const auto backdrop = backdrops->newest();
  ASSERT_NE(backdrop, before);
  EXPECT_EQ(backdrop->origin().view, before->origin().view);
  EXPECT_EQ(backdrop->origin().frame, 2U);
  const raster::SemiPlanarImage& image = backdrop->image();
  ASSERT_EQ(image.rect, (world::Rect{-8, -8, 400, 184}));
  const auto luma = [&](int x, int y) { return static_cast<int>(image.y()[image.lumaAt(x, y)]); };
  for (const int y : {-8, 90, 183}) {
    EXPECT_NEAR(luma(-8, y), 0x80, 1) << y;
    EXPECT_NEAR(luma(335, y), 0x80, 1) << y;
    EXPECT_NEAR(luma(336, y), 0x30, 1) << y;
    EXPECT_NEAR(luma(399, y), 0x30, 1) << y;
  }
  EXPECT_FLOAT_EQ(backdrop->nearness().front(), 1.0F / 5.0F);
  EXPECT_FLOAT_EQ(backdrop->nearness().back(), 1.0F / 4.0F);
  EXPECT_EQ(at(319, 179), kStill) << "the frame itself sees what it saw";
}

TEST_F(CompositorBackdrops, DropsAnExtensionOfAMissingBackdrop) {
  show(frameOf(1, 2.0F, true));
  const CompleteFrame late = extendedBy(3);
  show(extendedBy(2));
  show(late);
  EXPECT_THAT(shown->numbers(), ElementsAre(1, 2));
  EXPECT_EQ(backdrops->newest()->origin().frame, 2U);
}

TEST_F(CompositorBackdrops, IsFinalIfNothingBetterIsPending) {
  show(frameOf(1, 2.0F, true));
  EXPECT_TRUE(backdrops->newest()->origin().isFinal);
  show(extendedBy(2));
  EXPECT_TRUE(backdrops->newest()->origin().isFinal);
  CompleteFrame failed = frameOf(1, 2.0F, true);
  failed.payloads.front() = testing::failure("it is away");
  show(failed);
  EXPECT_FALSE(backdrops->newest()->origin().isFinal);
  show(extendedBy(3));
  EXPECT_FALSE(backdrops->newest()->origin().isFinal) << "what it extends was not";
  CompleteFrame stale = frameOf(1, 2.0F, true);
  stale.stale = true;
  show(stale);
  EXPECT_FALSE(backdrops->newest()->origin().isFinal);
}

TEST_F(CompositorBackdrops, DropsAFrameWithoutBackdrop) {
  show(frameOf(2, 2.0F, false));
  EXPECT_THAT(shown->numbers(), ::testing::IsEmpty());
  EXPECT_EQ(done, 1);
  show(frameOf(1, 2.0F, true));
  EXPECT_THAT(shown->numbers(), ElementsAre(1)) << "the next is";
}

}  // namespace
}  // namespace grove::node
