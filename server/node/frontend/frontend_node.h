#pragma once

#include <atomic>
#include <functional>
#include <memory>

#include "node/frontend/compositing/compositor.h"
#include "node/frontend/decompressor.h"
#include "node/frontend/frames/frame_planner.h"
#include "node/frontend/frames/frames_in_flight.h"
#include "node/frontend/frontend_process.h"
#include "node/frontend/result_receiver.h"
#include "node/frontend/scene_analyzer.h"

namespace grove::node {

/// How many frames of a visitor are in progress at once, and how long one waits for its results.
struct FramePolicy {
  int framesInFlight = 1;        ///< 1 to kMaxFramesInFlight
  double deadlineSeconds = 0.5;  ///< then the frame shows the last results of missing objects
  bool backdrops = true;         ///< false: every frame draws every object
};

/// The left half of Figure 4.2: one visitor's pipeline from the camera to the composited frame. Thread-safe.
class FrontendNode {
 public:
  /// Calls `look` for the camera, on a worker thread, when a frame's turn comes. Sends finished frames to `next`. Calls
  /// `frameEnded` (may be empty) once for each requested frame, composited or dropped, on any thread; it may request
  /// frames, also of other nodes. `frontend` outlives the node.
  FrontendNode(SessionId session, const FramePolicy& policy, SceneAnalyzer::Look look,
               std::shared_ptr<pipeline::Inlet<FinishedFrame>> next, std::function<void()> frameEnded,
               FrontendProcess& frontend);
  ~FrontendNode();
  FrontendNode(const FrontendNode&) = delete;
  FrontendNode& operator=(const FrontendNode&) = delete;

  /// Starts a frame. Returns false, without a call of `frameEnded`, if `framesInFlight` are in progress.
  bool requestFrame();

  /// Returns whether `framesInFlight` are in progress.
  [[nodiscard]] bool full() const { return inFlight_->full(); }

  /// Checks for frames past their deadline, and ends them. Call regularly: a frame may end late by the time between two
  /// calls. Returns at once.
  void checkDeadline();

  /// Accepts no more frames; runs in progress finish, and their results are dropped.
  void close();

 private:
  const SessionId session_;
  FrontendProcess& frontend_;
  const std::shared_ptr<FramesInFlight> inFlight_;
  std::atomic<FrameNumber> nextFrame_{1};
  std::shared_ptr<SceneAnalyzer> analyzer_;
  std::shared_ptr<FramePlanner> planner_;
  std::shared_ptr<ResultReceiver> resultReceiver_;
  std::shared_ptr<Decompressor> decompressor_;
  std::shared_ptr<Compositor> compositor_;
};

}  // namespace grove::node
