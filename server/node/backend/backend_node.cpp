#include "node/backend/backend_node.h"

#include "node/backend/renderer.h"
#include "node/backend/simulator.h"

namespace grove::node {
namespace {

std::shared_ptr<Answerer> makeAnswerer(std::string_view type, BackendHalf& half, pipeline::Timeline& timeline) {
  if (half.kind() == NodeKind::kSimulation) return std::make_shared<Simulator>(type, half, timeline);
  return std::make_shared<Renderer>(type, half, timeline);
}

}  // namespace

BackendNode::BackendNode(const ObjectType& type, world::TypeIndex index, const BackendServices& services,
                         Transport& transport)
    : half_(type.makeBackend(services, index)),
      receiver_(std::make_shared<RequestReceiver>(services.workers, services.timeline)),
      answerer_(makeAnswerer(type.name(), *half_, services.timeline)),
      compressor_(std::make_shared<Compressor>(transport, type.name(), services.workers, services.timeline)),
      sender_(std::make_shared<ResultSender>(transport, services.workers, services.timeline)) {
  receiver_->connect(answerer_);
  answerer_->connect(compressor_);
  compressor_->connect(sender_);
  transport.connectBackend(index, receiver_);
}

BackendNode::~BackendNode() = default;

void BackendNode::close() {
  receiver_->close();
  answerer_->close();
  compressor_->close();
  sender_->close();
}

}  // namespace grove::node
