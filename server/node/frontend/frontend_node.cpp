#include "node/frontend/frontend_node.h"

#include <cassert>
#include <utility>

#include "node/limits.h"
#include "node/load_shedding.h"

namespace grove::node {

FrontendNode::FrontendNode(SessionId session, const FramePolicy& policy, SceneAnalyzer::Look look,
                           std::shared_ptr<pipeline::Inlet<FinishedFrame>> next, std::function<void()> frameEnded,
                           FrontendProcess& frontend)
    : session_(session),
      frontend_(frontend),
      inFlight_(std::make_shared<FramesInFlight>(policy.framesInFlight, std::move(frameEnded))) {
  assert(policy.framesInFlight >= 1 && policy.framesInFlight <= kMaxFramesInFlight);
  const auto endFrame = [frames = inFlight_] { frames->end(); };
  const auto frames = static_cast<std::size_t>(policy.framesInFlight);
  const std::size_t results = frames * kMaxObjectsPerFrame;
  const auto halves = std::make_shared<VisitorHalves>(frontend);
  const FrontendTools& tools = frontend.tools();

  analyzer_ = std::make_shared<SceneAnalyzer>(frontend.layout(), std::move(look), policy.deadlineSeconds, endFrame,
                                              tools.workers, tools.timeline);
  const auto backdrops = std::make_shared<BackdropStore>(frontend.redrawTurns());
  std::unique_ptr<BackdropPlanner> backdropPlanner;
  if (policy.backdrops) {
    backdropPlanner = std::make_unique<BackdropPlanner>(
        frontend.layout(), halves, backdrops, [&workers = tools.workers] { return errorFactor(workers.busyShare()); });
  }
  planner_ =
      std::make_shared<FramePlanner>(results + 2 * frames + 1, frontend, halves, std::move(backdropPlanner), endFrame);
  resultReceiver_ = std::make_shared<ResultReceiver>(results, tools.workers, tools.timeline);
  decompressor_ = std::make_shared<Decompressor>(frontend);
  compositor_ = std::make_shared<Compositor>(frames, frontend, halves, backdrops, endFrame);

  analyzer_->connect(planner_);
  planner_->connect(compositor_);
  resultReceiver_->connect(decompressor_);
  decompressor_->connect(planner_);
  compositor_->connect(std::move(next));
  // Last, because results may come at once: late ones of an earlier node of this session.
  frontend_.connect(session_, resultReceiver_);
}

FrontendNode::~FrontendNode() { close(); }

bool FrontendNode::requestFrame() {
  if (!inFlight_->begin()) return false;
  if (analyzer_->push({session_, nextFrame_++}) == pipeline::PushResult::kAccepted) return true;
  // A frame that close() has ended meanwhile counts as begun.
  return !inFlight_->cancel();
}

void FrontendNode::checkDeadline() {
  if (inFlight_->count() > 0) planner_->push(DeadlineCheck{});
}

void FrontendNode::close() {
  frontend_.disconnect(session_);
  analyzer_->close();
  planner_->close();
  resultReceiver_->close();
  decompressor_->close();
  compositor_->close();
  inFlight_->close();
}

}  // namespace grove::node
