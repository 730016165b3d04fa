#include "node/backend/backend_pipeline.h"

#include "node/backend/renderer.h"
#include "node/backend/simulator.h"

namespace grove::node {
namespace {

std::shared_ptr<RequestHandler> makeHandler(std::string_view type, BackendHalf& half, const BackendServices& services) {
  if (half.kind() == NodeKind::kSimulation) {
    return std::make_shared<Simulator>(type, half, services.timeline);
  }
  return std::make_shared<Renderer>(type, half, services.timeline);
}

}  // namespace

BackendPipeline::BackendPipeline(const BackendType& type, world::TypeIndex index, const BackendServices& services)
    : half_(type.makeHalf(services, index)),
      receiver_(std::make_shared<RequestReceiver>(services.workers, services.timeline)),
      handler_(makeHandler(type.name(), *half_, services)),
      compressor_(std::make_shared<Compressor>(type.name(), services.workers, services.timeline)),
      sender_(std::make_shared<ResultSender>(services.workers, services.timeline)) {
  receiver_->connect(handler_);
  handler_->connect(compressor_);
  compressor_->connect(sender_);
}

BackendPipeline::~BackendPipeline() = default;

void BackendPipeline::close() {
  receiver_->close();
  handler_->close();
  compressor_->close();
  sender_->close();
}

}  // namespace grove::node
