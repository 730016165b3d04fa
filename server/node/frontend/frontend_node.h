#pragma once

#include <atomic>
#include <functional>
#include <memory>

#include "node/frontend/compositing/compositor.h"
#include "node/frontend/decompressor.h"
#include "node/frontend/frame_planner.h"
#include "node/frontend/frames_in_flight.h"
#include "node/frontend/frontend_process.h"
#include "node/frontend/result_receiver.h"
#include "node/frontend/scene_analyzer.h"

namespace grove::node {

/// How many frames of a visitor are made at once, and how long one waits for its results.
struct FramePolicy {
  int framesInFlight = 1;        ///< 1 to kMaxFramesInFlight
  double deadlineSeconds = 0.5;  ///< then it is shown with the last results of the objects that did not answer
  bool backdrops = true;         ///< false: every object is drawn for every frame
};

/// The left half of Figure 4.2: one visitor's pipeline from the camera to the composited frame. Any thread.
class FrontendNode {
 public:
  /// `look` reads the camera, on a worker thread, when a frame's turn has come. Finished frames go to `next`.
  /// `frameEnded` (may be empty) is called once for each frame that was requested: it is composited, or dropped. Any
  /// thread; it may request frames, of other nodes too. `frontend` outlives the node.
  FrontendNode(SessionId session, const FramePolicy& policy, SceneAnalyzer::Look look,
               std::shared_ptr<pipeline::Inlet<FinishedFrame>> next, std::function<void()> frameEnded,
               FrontendProcess& frontend);
  ~FrontendNode();
  FrontendNode(const FrontendNode&) = delete;
  FrontendNode& operator=(const FrontendNode&) = delete;

  /// Starts a frame, unless `framesInFlight` are being made already: then false, and it does not end.
  bool requestFrame();

  /// Whether `framesInFlight` are being made.
  [[nodiscard]] bool full() const { return inFlight_->full(); }

  /// To be called every now and then, so that a frame whose results do not come ends by its deadline, or as long after
  /// it as lies between two calls. Returns at once.
  void checkDeadline();

  /// Takes no more frames; runs in progress finish and their results are dropped.
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
