#include "node/transport/reference_transport.h"

#include <utility>

namespace grove::node {

pipeline::PushResult ReferenceTransport::send(ToBackend message) {
  return backend_.use([&](BackendPort* port) {
    return port == nullptr ? pipeline::PushResult::kClosed : port->receive(std::move(message));
  });
}

void ReferenceTransport::send(ToFrontend message) {
  frontend_.use([&](FrontendPort* port) {
    if (port != nullptr) port->receive(std::move(message));
  });
}

}  // namespace grove::node
