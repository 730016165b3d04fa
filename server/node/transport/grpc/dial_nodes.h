#pragma once

#include <chrono>
#include <memory>
#include <span>
#include <string>

#include "node/transport/grpc/tls/link_tls.h"
#include "node/transport/node_router.h"
#include "pipeline/executor.h"
#include "pipeline/timeline.h"

namespace grove::node {

/// Links to the backend nodes at these addresses (HOST:PORT); returns when each has welcomed `hello`. Throws
/// EnvironmentError if a node does not respond within `patience`, refuses, or has a rejected certificate, or if two
/// nodes serve one object. Workers and timeline outlive the links.
[[nodiscard]] std::unique_ptr<NodeRouter> dialNodes(std::span<const std::string> addresses, const NodeHello& hello,
                                                    std::chrono::milliseconds patience, pipeline::Executor& executor,
                                                    pipeline::Timeline& timeline, const LinkTls& tls = {});

}  // namespace grove::node
