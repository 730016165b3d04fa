#include "node/transport/reference_transport.h"

#include <mutex>
#include <utility>

namespace grove::node {

void ReferenceTransport::connect(BackendPort& backend) {
  const std::unique_lock lock(backendMutex_);
  backend_ = &backend;
}

void ReferenceTransport::connect(FrontendPort& frontend) {
  const std::unique_lock lock(frontendMutex_);
  frontend_ = &frontend;
}

void ReferenceTransport::leaveBackend() {
  const std::unique_lock lock(backendMutex_);
  backend_ = nullptr;
}

void ReferenceTransport::leaveFrontend() {
  const std::unique_lock lock(frontendMutex_);
  frontend_ = nullptr;
}

pipeline::PushResult ReferenceTransport::send(ToBackend message) {
  const std::shared_lock lock(backendMutex_);
  return backend_ == nullptr ? pipeline::PushResult::kClosed : backend_->receive(std::move(message));
}

void ReferenceTransport::send(ToFrontend message) {
  const std::shared_lock lock(frontendMutex_);
  if (frontend_ != nullptr) frontend_->receive(std::move(message));
}

}  // namespace grove::node
