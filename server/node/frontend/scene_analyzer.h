#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "node/frontend/frames/frame_planner.h"
#include "node/messages.h"
#include "pipeline/outlet.h"
#include "world/layout.h"

namespace grove::node {

/// A request for one more frame.
struct FrameTicket {
  SessionId session = 0;
  FrameNumber frame = 0;
};

inline pipeline::TraceTag traceTag(const FrameTicket& ticket) { return traceTag(ticket.session, ticket.frame); }

/// Returns the objects whose bounds the camera sees, back to front by the distance of their farthest corners, so that
/// enclosing objects (the sky, the ground) come before the others; at most the nearest kMaxObjectsPerFrame. Skips the
/// viewer's own figure.
[[nodiscard]] std::vector<VisibleObject> visibleObjects(const world::Layout& layout, const View& view);

/// First box of Figure 4.2: reads the camera, as late as possible, finds the visible objects, and sends the sorted list
/// (section 4.2, step 1) to the Frame Planner.
class SceneAnalyzer final : public pipeline::Stage<FrameTicket> {
 public:
  using Look = std::function<View(FrameNumber)>;
  /// Calls `frameFailed` for a ticket without a frame.
  SceneAnalyzer(const world::Layout& layout, Look look, double deadlineSeconds, std::function<void()> frameFailed,
                pipeline::Executor& executor, pipeline::Timeline& timeline);
  void connect(std::shared_ptr<pipeline::Inlet<FramePlannerInput>> framePlanner);

 protected:
  void process(std::span<FrameTicket> tickets, pipeline::Run& run) override;
  void recover(FrameTicket& ticket, const std::string& reason, pipeline::Run& run) override;

 private:
  const world::Layout& layout_;
  const Look look_;
  const double deadlineSeconds_;
  const std::function<void()> frameFailed_;
  pipeline::Outlet<FramePlannerInput> framePlanner_;
};

}  // namespace grove::node
