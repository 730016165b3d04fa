#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <variant>

#include "node/frontend/backdrops/backdrop_planner.h"
#include "node/frontend/frame_records.h"
#include "node/frontend/request_sender.h"
#include "node/frontend/visitor_halves.h"
#include "pipeline/outlet.h"

namespace grove::node {

/// A look for frames that have waited too long for their results.
struct DeadlineCheck {};

inline pipeline::TraceTag traceTag(const DeadlineCheck&) { return {}; }

/// The backdrop that a frame shows has been sent to the Compositor. The planner's own note to itself: a run may send
/// one frame for each input.
struct BackdropSent {
  FrameNumber showing = 0;
};

inline pipeline::TraceTag traceTag(const BackdropSent&) { return {}; }

/// A frame that begins, what came of something that it asked for, a look at the clock, or a frame that need not wait
/// any more.
using FramePlannerInput = std::variant<std::shared_ptr<const FrameList>, Result, DeadlineCheck, BackdropSent>;

inline pipeline::TraceTag traceTag(const FramePlannerInput& input) {
  return std::visit([](const auto& held) { return traceTag(held); }, input);
}

/// Turns the Scene Analyzer's list into a frame that the Compositor can show: asks each object's frontend half what it
/// needs, passes that to the Request Sender, and repeats this with each result until every object has its payload.
///
/// A frame that is complete only after a newer one was shown is dropped. One that is not complete by its deadline is
/// shown with the last results of what is missing; what comes later still is the last result then. A request that is
/// refused is a Failure at once, so that its frame is completed without it.
class FramePlanner final : public pipeline::Stage<FramePlannerInput> {
 public:
  /// `frameDropped` is called once for every frame that began and is not sent on. `frontend` outlives it. Without
  /// `backdrops` every frame draws all that it sees.
  FramePlanner(std::size_t capacity, FrontendProcess& frontend, std::shared_ptr<VisitorHalves> halves,
               std::unique_ptr<BackdropPlanner> backdrops, std::function<void()> frameDropped);
  void connect(std::shared_ptr<pipeline::Inlet<CompleteFrame>> compositor);

 protected:
  void process(std::span<FramePlannerInput> inputs, pipeline::Run& run) override;
  void recover(FramePlannerInput& input, const std::string& reason, pipeline::Run& run) override;

 private:
  void begin(const std::shared_ptr<const FrameList>& seen, pipeline::Run& run);
  void resume(Result result, pipeline::Run& run);
  /// Ends one whose deadline has passed, filled in, and drops those before it: the newest, or the first that draws a
  /// backdrop. If more are left, looks again.
  void endOverdue(pipeline::Run& run);

  /// Goes on with one object until it waits or has its payload.
  void proceed(FrameRecord& frame, std::uint32_t slot, std::optional<Payload> answer);
  [[nodiscard]] Plan planOf(const FrameRecord& frame, std::uint32_t slot, const Payload* answer);
  /// Nothing yet, if it is under way.
  [[nodiscard]] std::optional<Payload> request(const FrameRecord& frame, std::uint32_t slot);
  void take(FrameRecord& frame, std::uint32_t slot, Payload payload);

  void fillIn(FrameRecord& frame);
  /// Ends it if nothing is missing, its backdrop included.
  void endIfComplete(FrameRecord& frame, pipeline::Run& run);
  /// Shows a frame in the making, or drops it if a newer one was shown.
  void end(FrameRecord& frame, pipeline::Run& run);
  void drop(FrameRecord& frame);

  FrontendProcess& frontend_;
  pipeline::Timeline& timeline_;
  const std::shared_ptr<VisitorHalves> halves_;
  const std::function<void()> frameDropped_;
  const std::unique_ptr<BackdropPlanner> backdrops_;
  RequestSender sender_;
  FrameRecords frames_;
  log::Limited overdue_;
  pipeline::Outlet<CompleteFrame> compositor_;
};

}  // namespace grove::node
