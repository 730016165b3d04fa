#pragma once

#include <cstdint>

#include "node/transport/transport.h"

namespace grove::node {

/// How a frontend process and a backend node are linked.
enum class TransportKind : std::uint8_t {
  kReference,  ///< they share memory
  kBytes,      ///< all that travels is encoded and decoded
  kGrpc,       ///< the same, through gRPC and a socket of this machine
};

[[nodiscard]] TransportFactory transportFactory(TransportKind kind);

}  // namespace grove::node
