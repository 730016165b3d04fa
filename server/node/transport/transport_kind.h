#pragma once

#include <cstdint>

#include "node/transport/transport.h"

namespace grove::node {

/// The kinds of links between a frontend process and a backend node.
enum class TransportKind : std::uint8_t {
  kReference,  ///< they share memory
  kBytes,      ///< every message is encoded and decoded
  kGrpc,       ///< as kBytes, through gRPC and a local socket
};

[[nodiscard]] TransportFactory transportFactory(TransportKind kind);

}  // namespace grove::node
