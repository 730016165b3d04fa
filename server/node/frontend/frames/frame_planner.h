#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <variant>

#include "node/frontend/backdrops/backdrop_planner.h"
#include "node/frontend/frames/frame_records.h"
#include "node/frontend/frames/reuse_counter.h"
#include "node/frontend/request_sender.h"
#include "node/frontend/visitor_halves.h"
#include "pipeline/outlet.h"

namespace grove::node {

/// A check for frames past their deadline.
struct DeadlineCheck {};

inline pipeline::TraceTag traceTag(const DeadlineCheck&) { return {}; }

/// The backdrop that a frame shows has been sent to the Compositor. The planner sends this to itself, because a run may
/// send only one frame per input.
struct BackdropSent {
  FrameNumber showing = 0;
};

inline pipeline::TraceTag traceTag(const BackdropSent&) { return {}; }

/// A new frame, a result of a request, a check of deadlines, or a frame that no longer waits for its backdrop.
using FramePlannerInput = std::variant<std::shared_ptr<const FrameList>, Result, DeadlineCheck, BackdropSent>;

inline pipeline::TraceTag traceTag(const FramePlannerInput& input) {
  return std::visit([](const auto& held) { return traceTag(held); }, input);
}

/// Turns the Scene Analyzer's list into a frame that the Compositor can show: requests from each object's frontend half
/// what it needs, passes that to the Request Sender, and repeats this with each result until every object has its
/// payload.
///
/// Drops a frame that becomes complete after a newer one was shown. At its deadline, shows an incomplete frame with the
/// last results of the missing objects; late results become the last results. A refused request is a Failure at once,
/// so its frame is completed without it.
class FramePlanner final : public pipeline::Stage<FramePlannerInput> {
 public:
  /// Calls `frameDropped` once for every frame that began and is not sent on. `frontend` outlives it. Without
  /// `backdrops`, every frame draws everything in view.
  FramePlanner(std::size_t capacity, FrontendProcess& frontend, std::shared_ptr<VisitorHalves> halves,
               std::unique_ptr<BackdropPlanner> backdrops, std::function<void()> frameDropped);
  void connect(std::shared_ptr<pipeline::Inlet<CompleteFrame>> compositor);

 protected:
  void process(std::span<FramePlannerInput> inputs, pipeline::Run& run) override;
  void recover(FramePlannerInput& input, const std::string& reason, pipeline::Run& run) override;

 private:
  void begin(const std::shared_ptr<const FrameList>& seen, pipeline::Run& run);
  void resume(Result result, pipeline::Run& run);
  /// Completes one frame past its deadline with last results, and drops earlier ones: the newest, or the first that
  /// draws a backdrop. If more are left, checks again.
  void endOverdue(pipeline::Run& run);

  /// Continues with one object until it waits or has its payload.
  void proceed(FrameRecord& frame, std::uint32_t slot, std::optional<Payload> answer);
  [[nodiscard]] Plan planOf(const FrameRecord& frame, std::uint32_t slot, const Payload* answer);
  /// Empty if the result is still to come.
  [[nodiscard]] std::optional<Payload> request(const FrameRecord& frame, std::uint32_t slot);
  void take(FrameRecord& frame, std::uint32_t slot, Payload payload);

  void fillIn(FrameRecord& frame);
  /// Ends it if nothing is missing, including its backdrop.
  void endIfComplete(FrameRecord& frame, pipeline::Run& run);
  /// Shows a frame in progress, or drops it if a newer one was shown.
  void end(FrameRecord& frame, pipeline::Run& run);
  void drop(FrameRecord& frame);

  FrontendProcess& frontend_;
  pipeline::Timeline& timeline_;
  const std::shared_ptr<VisitorHalves> halves_;
  const std::function<void()> frameDropped_;
  const std::unique_ptr<BackdropPlanner> backdrops_;
  RequestSender sender_;
  FrameRecords frames_;
  ReuseCounter reuse_;
  log::Limited overdue_;
  pipeline::Outlet<CompleteFrame> compositor_;
};

}  // namespace grove::node
