#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <variant>
#include <vector>

#include "node/frontend/last_results.h"
#include "node/frontend/result_table.h"
#include "node/frontend/visitor_halves.h"
#include "node/messages.h"
#include "pipeline/outlet.h"

namespace grove::node {

/// A look for frames that have waited too long for their results.
struct DeadlineCheck {};

inline pipeline::TraceTag traceTag(const DeadlineCheck&) { return {}; }

/// What some objects of a frame are to be shown with.
struct Answers {
  struct Slot {
    std::uint32_t slot = 0;
    Payload payload;
  };
  std::shared_ptr<const View> view;
  std::vector<Slot> slots;
};

inline pipeline::TraceTag traceTag(const Answers& answers) {
  return {numberOf(answers.view->session), answers.view->frame};
}

/// The Scene Analyzer's list announces a frame; answers fill it.
using CompositorInput = std::variant<std::shared_ptr<const FrameList>, Answers, DeadlineCheck>;

inline pipeline::TraceTag traceTag(const CompositorInput& input) {
  return std::visit([](const auto& held) { return traceTag(held); }, input);
}

/// How many frames of a visitor are made at once, and how long one waits for its results.
struct FramePolicy {
  int framesInFlight = 1;        ///< 1 to kMaxFramesInFlight
  double deadlineSeconds = 0.5;  ///< then it is shown with the last results of the objects that did not answer
};

/// Last box of Figure 4.2: when all objects of a frame are answered, composites their pictures and layers by depth,
/// then lets the layers draw, back to front (section 4.2, step 10). A frame that is complete only after a newer one was
/// shown is dropped; one that is not complete by its deadline is shown with the last results of what is missing. What
/// comes later still is the last result then.
class Compositor final : public pipeline::Stage<CompositorInput> {
 public:
  /// `frameDone` is called once for every announced frame, shown or not.
  /// `frontend` outlives it.
  Compositor(FrontendProcess& frontend, std::shared_ptr<VisitorHalves> halves, const FramePolicy& policy,
             std::function<void()> frameDone);
  void connect(std::shared_ptr<pipeline::Inlet<FinishedFrame>> next);

 protected:
  void process(std::span<CompositorInput> inputs, pipeline::Run& run) override;

 private:
  void show(CompleteFrame frame, pipeline::Run& run);
  void take(Answers answers, pipeline::Run& run);
  /// Of a frame that has ended.
  void takeStale(FrameNumber frame, Answers::Slot answer);
  /// The newest frame whose deadline has passed, filled in; ends those before it.
  [[nodiscard]] std::optional<CompleteFrame> takeOverdue();
  void fillIn(CompleteFrame& frame);
  [[nodiscard]] std::shared_ptr<const raster::Image> composite(const CompleteFrame& frame);
  /// Something to lay over a frame.
  struct Placed {
    const VisibleObject& object;
    const raster::Image* picture;  ///< null: none
    std::unique_ptr<Layer> layer;  ///< null: the picture is all of it
    [[nodiscard]] bool opaque() const { return layer ? layer->opaque() : picture->opaque; }
  };
  /// Back to front.
  [[nodiscard]] std::vector<Placed> placedOf(const CompleteFrame& frame);
  /// What the layers are to have before they can be laid.
  void makeParts(const CompleteFrame& frame, std::span<Placed> placed);
  [[nodiscard]] pipeline::TimedParts timesOf(const CompleteFrame& frame);
  void layBand(const world::Rect& band, std::span<Placed* const> placed, pipeline::TimedParts& times,
               raster::Image& frame);

  FrontendProcess& frontend_;
  pipeline::Executor& executor_;
  pipeline::Timeline& timeline_;
  raster::ImagePool& images_;
  const std::shared_ptr<VisitorHalves> halves_;
  const std::function<void()> frameDone_;
  ResultTable table_;
  LastResults lastResults_;
  log::Limited overdue_;
  FrameNumber newestShown_ = 0;
  pipeline::Outlet<FinishedFrame> next_;
};

}  // namespace grove::node
