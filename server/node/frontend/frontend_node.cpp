#include "node/frontend/frontend_node.h"

#include <cassert>
#include <utility>

#include "node/limits.h"

namespace grove::node {

FrontendNode::FrontendNode(SessionId session, int framesInFlight, SceneAnalyzer::Look look,
                           std::shared_ptr<pipeline::Inlet<FinishedFrame>> next, const FrontendServices& services)
    : session_(session),
      framesInFlight_(framesInFlight),
      transport_(services.transport),
      inFlight_(std::make_shared<std::atomic<int>>(0)) {
  assert(framesInFlight >= 1 && framesInFlight <= kMostFramesInFlight);
  pipeline::Executor& workers = services.workers;
  pipeline::Timeline& timeline = services.timeline;

  const auto frameEnded = [count = inFlight_] { --*count; };

  analyzer_ = std::make_shared<SceneAnalyzer>(services.world, std::move(look), frameEnded, workers, timeline);
  requestSender_ = std::make_shared<RequestSender>(transport_, workers, timeline);
  resultReceiver_ = std::make_shared<ResultReceiver>(static_cast<std::size_t>(framesInFlight) * kMostObjectsPerFrame,
                                                     workers, timeline);
  decompressor_ = std::make_shared<Decompressor>(transport_, workers, timeline);
  compositor_ = std::make_shared<Compositor>(services.registry, services.images, services.memory, framesInFlight,
                                             frameEnded, workers, timeline);

  analyzer_->connect(compositor_, requestSender_);
  transport_.connectFrontend(session_, resultReceiver_);
  resultReceiver_->connect(decompressor_);
  decompressor_->connect(compositor_);
  compositor_->connect(std::move(next));
}

FrontendNode::~FrontendNode() { close(); }

bool FrontendNode::requestFrame() {
  int count = inFlight_->load();
  do {
    if (count >= framesInFlight_) return false;
  } while (!inFlight_->compare_exchange_weak(count, count + 1));
  if (analyzer_->push({session_, nextFrame_++}) == pipeline::PushResult::kAccepted) return true;
  --*inFlight_;
  return false;
}

void FrontendNode::close() {
  transport_.disconnectFrontend(session_);
  analyzer_->close();
  requestSender_->close();
  resultReceiver_->close();
  decompressor_->close();
  compositor_->close();
}

}  // namespace grove::node
