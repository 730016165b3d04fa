#include "node/frontend/frontend_node.h"

#include <cassert>
#include <utility>

#include "node/limits.h"

namespace grove::node {

FrontendNode::FrontendNode(SessionId session, const FramePolicy& policy, SceneAnalyzer::Look look,
                           std::shared_ptr<pipeline::Inlet<FinishedFrame>> next, std::function<void()> frameEnded,
                           const FrontendServices& services)
    : session_(session),
      transport_(services.transport),
      inFlight_(std::make_shared<FramesInFlight>(policy.framesInFlight, std::move(frameEnded))) {
  assert(policy.framesInFlight >= 1 && policy.framesInFlight <= kMostFramesInFlight);
  pipeline::Executor& workers = services.workers;
  pipeline::Timeline& timeline = services.timeline;

  const auto endFrame = [frames = inFlight_] { frames->end(); };

  analyzer_ = std::make_shared<SceneAnalyzer>(services.world, std::move(look), policy.deadlineSeconds, endFrame,
                                              workers, timeline);
  requestSender_ = std::make_shared<RequestSender>(transport_, workers, timeline);
  resultReceiver_ = std::make_shared<ResultReceiver>(
      static_cast<std::size_t>(policy.framesInFlight) * kMostObjectsPerFrame, workers, timeline);
  decompressor_ = std::make_shared<Decompressor>(transport_, workers, timeline);
  compositor_ = std::make_shared<Compositor>(services.registry, services.images, services.memory, policy, endFrame,
                                             workers, timeline);

  analyzer_->connect(compositor_, requestSender_);
  transport_.connectFrontend(session_, resultReceiver_);
  resultReceiver_->connect(decompressor_);
  decompressor_->connect(compositor_);
  compositor_->connect(std::move(next));
}

FrontendNode::~FrontendNode() { close(); }

bool FrontendNode::requestFrame() {
  if (!inFlight_->begin()) return false;
  if (analyzer_->push({session_, nextFrame_++}) == pipeline::PushResult::kAccepted) return true;
  // One that close() has ended meanwhile was begun for the caller.
  return !inFlight_->cancel();
}

void FrontendNode::checkDeadline() {
  if (inFlight_->count() > 0) compositor_->push(DeadlineCheck{});
}

void FrontendNode::close() {
  transport_.disconnectFrontend(session_);
  analyzer_->close();
  requestSender_->close();
  resultReceiver_->close();
  decompressor_->close();
  compositor_->close();
  inFlight_->close();
}

}  // namespace grove::node
