#pragma once

#include <gtest/gtest.h>

#include <atomic>
#include <cstddef>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "eventually.h"
#include "node/frontend/frame_lists.h"
#include "node/frontend/frames/frame_planner.h"
#include "node/transport/reference_transport.h"
#include "pipeline/worker_pool.h"

/// A Frame Planner whose neighbours are the test: it gives lists and results, and looks at requests and frames.
namespace grove::node::testing {

/// Of the only type.
inline world::Object objectOf(world::ObjectId id, const world::Bounds& bounds) {
  world::Object object;
  object.id = id;
  object.bounds = bounds;
  return object;
}

/// Keeps what a frontend process sends, and answers nothing.
class SilentBackend final : public BackendPort {
 public:
  pipeline::PushResult receive(ToBackend message) override {
    const std::lock_guard lock(mutex_);
    if (auto* const request = std::get_if<Request>(&message)) {
      if (full) return pipeline::PushResult::kRejected;
      requests_.push_back(std::move(*request));
    } else if (const auto* const cancel = std::get_if<Cancel>(&message)) {
      cancelled_.push_back(cancel->frame);
    }
    return pipeline::PushResult::kAccepted;
  }
  [[nodiscard]] std::vector<Request> requests() const {
    const std::lock_guard lock(mutex_);
    return requests_;
  }
  [[nodiscard]] std::vector<FrameNumber> cancelled() const {
    const std::lock_guard lock(mutex_);
    return cancelled_;
  }

  std::atomic<bool> full{false};

 private:
  mutable std::mutex mutex_;
  std::vector<Request> requests_;
  std::vector<FrameNumber> cancelled_;
};

/// In the Compositor's place: keeps the frames, or takes none as long as it is held.
class FrameShelf final : public pipeline::Inlet<CompleteFrame> {
 public:
  pipeline::PushResult push(CompleteFrame frame) override {
    const std::lock_guard lock(mutex_);
    frames_.push_back(std::move(frame));
    return pipeline::PushResult::kAccepted;
  }
  bool tryReserve(std::function<void()> onRoom) override {
    const std::lock_guard lock(mutex_);
    if (held_ && onRoom) onRoom_ = std::move(onRoom);
    return !held_;
  }
  void cancelReservation() override {}
  pipeline::PushResult pushReserved(CompleteFrame frame) override { return push(std::move(frame)); }

  void hold() {
    const std::lock_guard lock(mutex_);
    held_ = true;
  }
  void release() {
    std::function<void()> onRoom;
    {
      const std::lock_guard lock(mutex_);
      held_ = false;
      onRoom = std::exchange(onRoom_, {});
    }
    if (onRoom) onRoom();
  }
  [[nodiscard]] std::vector<CompleteFrame> frames() const {
    const std::lock_guard lock(mutex_);
    return frames_;
  }

 private:
  mutable std::mutex mutex_;
  bool held_ = false;
  std::function<void()> onRoom_;
  std::vector<CompleteFrame> frames_;
};

/// Plans as the test says; as the base class does if it says nothing.
class ScriptedHalf final : public FrontendHalf {
 public:
  using Script = std::function<Plan(const VisibleObject&, const Reply*)>;
  /// Distance of an object that stands still; nothing if it moves.
  using Stillness = std::function<std::optional<float>(const VisibleObject&)>;
  ScriptedHalf(const Script& script, const Stillness& stillness) : script_(script), stillness_(stillness) {}
  [[nodiscard]] Plan plan(const VisibleObject& object, const View& view, const SharedOf& shared,
                          const Reply* reply) override {
    return script_ ? script_(object, reply) : FrontendHalf::plan(object, view, shared, reply);
  }
  [[nodiscard]] std::optional<float> stillDistance(const VisibleObject& object, world::Vec3) const override {
    return stillness_ ? stillness_(object) : std::nullopt;
  }

 private:
  const Script& script_;
  const Stillness& stillness_;
};

class ScriptedType final : public FrontendType {
 public:
  ScriptedType(const ScriptedHalf::Script& script, const ScriptedHalf::Stillness& stillness)
      : script_(script), stillness_(stillness) {}
  [[nodiscard]] std::string_view name() const override { return "scripted"; }
  [[nodiscard]] std::unique_ptr<FrontendHalf> makeHalf(const FrontendTools&) const override {
    return std::make_unique<ScriptedHalf>(script_, stillness_);
  }

 private:
  const ScriptedHalf::Script& script_;
  const ScriptedHalf::Stillness& stillness_;
};

class PlannerStand : public ::testing::Test {
 public:
  PlannerStand() {
    transport.connect(static_cast<BackendPort&>(backend));
    planner->connect(shown);
  }
  ~PlannerStand() override {
    planner->close();
    workers.drain();
    transport.leaveBackend();
  }

 protected:
  void begin(std::shared_ptr<const FrameList> list) { give(std::move(list)); }
  void answer(FrameNumber frame, std::uint32_t slot, Payload payload) {
    Result result;
    result.session = 1;
    result.frame = frame;
    result.slot = slot;
    result.payload = std::move(payload);
    give(std::move(result));
  }
  void checkDeadline() { give(DeadlineCheck{}); }
  /// Has the planner work it off.
  void give(FramePlannerInput input) {
    ASSERT_EQ(planner->push(std::move(input)), pipeline::PushResult::kAccepted);
    settle();
  }
  void settle() {
    ASSERT_TRUE(tests::eventually([&] { return planner->idle(); }));
  }
  [[nodiscard]] std::vector<FrameNumber> shownNumbers() const {
    std::vector<FrameNumber> numbers;
    for (const CompleteFrame& frame : shown->frames()) numbers.push_back(frame.list->view->frame);
    return numbers;
  }
  [[nodiscard]] std::vector<Payload> newestPayloads() const { return shown->frames().back().payloads; }
  [[nodiscard]] std::uint64_t counted(const std::string& what) { return timeline.counters()[what]; }

  ScriptedHalf::Script script;
  ScriptedHalf::Stillness stillness;
  std::atomic<int> dropped{0};
  world::Layout layout = [] {
    world::Layout made;
    made.types = {"scripted"};
    return made;
  }();
  FrontendTypes types = [this] {
    FrontendTypes made;
    made.add(std::make_unique<ScriptedType>(script, stillness));
    return made;
  }();
  pipeline::Timeline timeline;
  pipeline::MemoryLedger memory;
  raster::ImagePool images;
  pipeline::WorkerPool workers{2};
  SilentBackend backend;
  ReferenceTransport transport;
  FrontendProcess process{1, layout, types, transport, {workers, timeline, memory, images, layout.sky}, 1U << 20U};
  const std::shared_ptr<FrameShelf> shown = std::make_shared<FrameShelf>();
  const std::shared_ptr<VisitorHalves> halves = std::make_shared<VisitorHalves>(process);
  RedrawTurns turns{2};
  const std::shared_ptr<BackdropStore> backdrops = std::make_shared<BackdropStore>(turns);
  const std::shared_ptr<FramePlanner> planner = std::make_shared<FramePlanner>(
      64, process, halves, std::make_unique<BackdropPlanner>(layout, halves, backdrops, [] { return 1.0F; }),
      [this] { ++dropped; });
};

}  // namespace grove::node::testing
