#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "node/frontend/frame_planner.h"
#include "node/messages.h"
#include "pipeline/outlet.h"
#include "world/layout.h"

namespace grove::node {

/// The call for one more frame.
struct FrameTicket {
  SessionId session = 0;
  FrameNumber frame = 0;
};

inline pipeline::TraceTag traceTag(const FrameTicket& ticket) { return traceTag(ticket.session, ticket.frame); }

/// The objects of the world whose bounds the camera sees, back to front by the distance of their farthest corners, so
/// that what encloses others (the sky, the ground) comes before them; the nearest kMaxObjectsPerFrame of them. The
/// viewer's own figure is left out.
[[nodiscard]] std::vector<VisibleObject> visibleObjects(const world::Layout& layout, const View& view);

/// First box of Figure 4.2: reads the camera, as late as possible, finds what it sees, and sends the sorted list on
/// (section 4.2, step 1): to the Frame Planner, which has requests sent, and gives the Compositor the list with what
/// came of them.
class SceneAnalyzer final : public pipeline::Stage<FrameTicket> {
 public:
  using Look = std::function<View(FrameNumber)>;
  /// `frameFailed` is called for a ticket that came to nothing.
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
