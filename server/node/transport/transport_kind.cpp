#include "node/transport/transport_kind.h"

#include <memory>

#include "node/transport/bytes_transport.h"
#include "node/transport/grpc/grpc_transport.h"
#include "node/transport/reference_transport.h"

namespace grove::node {

TransportFactory transportFactory(TransportKind kind) {
  return [kind](pipeline::Executor& executor, pipeline::Timeline& timeline) -> std::unique_ptr<Transport> {
    if (kind == TransportKind::kBytes) return std::make_unique<BytesTransport>(executor, timeline);
    if (kind == TransportKind::kGrpc) return std::make_unique<GrpcTransport>(executor, timeline);
    return std::make_unique<ReferenceTransport>();
  };
}

}  // namespace grove::node
