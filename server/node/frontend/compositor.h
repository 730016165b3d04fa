#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <variant>

#include "node/frontend/last_results.h"
#include "node/frontend/result_table.h"
#include "node/messages.h"
#include "node/object_type.h"
#include "node/registry.h"
#include "pipeline/memory_ledger.h"
#include "pipeline/outlet.h"

namespace grove::node {

/// A look for frames that have waited too long for their results.
struct DeadlineCheck {};

inline pipeline::TraceTag traceTag(const DeadlineCheck&) { return {}; }

/// The Scene Analyzer's list announces a frame; results fill it.
using CompositorInput = std::variant<std::shared_ptr<const FrameList>, Result, DeadlineCheck>;

inline pipeline::TraceTag traceTag(const CompositorInput& input) {
  return std::visit([](const auto& held) { return traceTag(held); }, input);
}

/// How many frames of a visitor are made at once, and how long one waits for its results.
struct FramePolicy {
  int framesInFlight = 1;        ///< 1 to kMostFramesInFlight
  double deadlineSeconds = 0.5;  ///< then it is shown with the last results of the objects that did not answer
};

/// Last box of Figure 4.2: when all requests of a frame are fulfilled, composites their images by depth, then lets each
/// object type's frontend half draw its data, back to front (section 4.2, step 10). A frame that is complete only after
/// a newer one was shown is dropped; one that is not complete by its deadline is shown with the last results of what is
/// missing. What comes later still is the last result then.
class Compositor final : public pipeline::Stage<CompositorInput> {
 public:
  /// `frameDone` is called once for every announced frame, shown or not.
  Compositor(const Registry& registry, raster::ImagePool& images, pipeline::MemoryLedger& memory,
             const FramePolicy& policy, std::function<void()> frameDone, pipeline::Executor& executor,
             pipeline::Timeline& timeline);
  void connect(std::shared_ptr<pipeline::Inlet<FinishedFrame>> next);

 protected:
  void process(std::span<CompositorInput> inputs, pipeline::Run& run) override;

 private:
  void show(CompleteFrame frame, pipeline::Run& run);
  /// Of a frame that has ended.
  void takeLate(Result result);
  /// The newest frame whose deadline has passed, filled in; ends those before it.
  [[nodiscard]] std::optional<CompleteFrame> takeOverdue();
  void fillIn(CompleteFrame& frame);
  [[nodiscard]] std::shared_ptr<const raster::Image> composite(const CompleteFrame& frame);
  /// Something to lay over a frame.
  struct Layer {
    const VisibleObject& object;
    const Payload& payload;
    FrontendHalf* half;  ///< null if images are all of it
  };
  [[nodiscard]] pipeline::TimedParts timesOf(const CompleteFrame& frame);
  void layBand(const world::Rect& band, std::span<const Layer> layers, const View& view, pipeline::TimedParts& times,
               raster::Image& frame);
  void tellMemory();
  FrontendHalf* halfOf(world::TypeIndex type);

  pipeline::Executor& executor_;
  const Registry& registry_;
  pipeline::Timeline& timeline_;
  raster::ImagePool& images_;
  pipeline::MemoryLedger& memory_;
  const std::function<void()> frameDone_;
  ResultTable table_;
  LastResults lastResults_;
  log::Limited overdue_;
  FrameNumber newestShown_ = 0;
  struct TypeHalf {
    TypeHalf(const ObjectType& type, pipeline::MemoryLedger& memory)
        : half(type.makeFrontend()), held(memory, "frontends", type.name(), pipeline::Work::kPerUserFrontend) {}
    std::unique_ptr<FrontendHalf> half;  ///< null if images are all of it
    pipeline::HeldMemory held;
  };
  std::map<world::TypeIndex, TypeHalf> halves_;
  pipeline::Outlet<FinishedFrame> next_;
};

}  // namespace grove::node
