#include "node/transport/reference_transport.h"

#include <utility>

namespace grove::node {

pipeline::PushResult ReferenceTransport::send(ToBackend message) {
  return backend_.use([&](BackendPort* port) {
    return port == nullptr ? pipeline::PushResult::kClosed : port->receive(std::move(message));
  });
}

pipeline::PushResult ReferenceTransport::send(ToFrontend message) {
  return frontend_.use([&](FrontendPort* port) {
    if (port == nullptr) return pipeline::PushResult::kClosed;
    port->receive(std::move(message));
    return pipeline::PushResult::kAccepted;
  });
}

}  // namespace grove::node
