#include "node/frontend/compositing/compositor.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <functional>
#include <mutex>
#include <stdexcept>

#include "eventually.h"
#include "node/frontend/frame_lists.h"
#include "node/transport/reference_transport.h"
#include "pipeline/worker_pool.h"

namespace grove::node {
namespace {

using ::testing::ElementsAre;
using testing::listOf;
using testing::picture;

/// Draws nothing, or throws where it would.
class BreakableHalf final : public FrontendHalf {
 public:
  explicit BreakableHalf(const std::atomic<bool>& broken) : broken_(broken) {}
  [[nodiscard]] std::unique_ptr<Layer> layer(const VisibleObject&, const Payload&, const View&) override {
    if (broken_) throw std::runtime_error("the layer is broken");
    return nullptr;
  }

 private:
  const std::atomic<bool>& broken_;
};

class BreakableType final : public FrontendType {
 public:
  explicit BreakableType(const std::atomic<bool>& broken) : broken_(broken) {}
  [[nodiscard]] std::string_view name() const override { return "breakable"; }
  [[nodiscard]] std::unique_ptr<FrontendHalf> makeHalf(const FrontendTools&) const override {
    return std::make_unique<BreakableHalf>(broken_);
  }

 private:
  const std::atomic<bool>& broken_;
};

/// Takes every frame at once.
class Numbers final : public pipeline::Inlet<FinishedFrame> {
 public:
  pipeline::PushResult push(FinishedFrame frame) override {
    const std::lock_guard lock(mutex_);
    numbers_.push_back(frame.view->frame);
    return pipeline::PushResult::kAccepted;
  }
  bool tryReserve(std::function<void()>) override { return true; }
  void cancelReservation() override {}
  pipeline::PushResult pushReserved(FinishedFrame frame) override { return push(std::move(frame)); }
  [[nodiscard]] std::vector<FrameNumber> all() const {
    const std::lock_guard lock(mutex_);
    return numbers_;
  }

 private:
  mutable std::mutex mutex_;
  std::vector<FrameNumber> numbers_;
};

TEST(Compositor, EndsEveryFrameOnceThoughItThrows) {
  std::atomic<bool> broken{false};
  std::atomic<int> done{0};
  world::Layout layout;
  layout.types = {"breakable"};
  FrontendTypes types;
  types.add(std::make_unique<BreakableType>(broken));
  pipeline::Timeline timeline;
  pipeline::MemoryLedger memory;
  raster::ImagePool images;
  pipeline::WorkerPool workers{2};
  ReferenceTransport transport;
  FrontendProcess process(1, layout, types, transport, {workers, timeline, memory, images, layout.sky}, 0);
  const auto compositor =
      std::make_shared<Compositor>(1, process, std::make_shared<VisitorHalves>(process), [&] { ++done; });
  const auto shown = std::make_shared<Numbers>();
  compositor->connect(shown);
  for (FrameNumber frame = 1; frame <= 3; ++frame) {
    broken = frame == 2;
    ASSERT_EQ(compositor->push({listOf(frame, 1), {picture(5)}}), pipeline::PushResult::kAccepted);
    ASSERT_TRUE(tests::eventually([&] { return compositor->idle(); }));
    EXPECT_EQ(done, static_cast<int>(frame));
  }
  EXPECT_THAT(shown->all(), ElementsAre(1, 3));
  EXPECT_EQ(timeline.totals().at("Compositor").failures, 1U);
}

}  // namespace
}  // namespace grove::node
