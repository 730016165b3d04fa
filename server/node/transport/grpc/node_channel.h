#pragma once

#include <grpcpp/channel.h>

#include <memory>
#include <string>

#include "node/transport/grpc/tls/link_tls.h"

namespace grove::node {

/// A channel to the node at HOST:PORT, with a connection of its own, which is made by the first call.
[[nodiscard]] std::shared_ptr<grpc::Channel> channelTo(const std::string& address, const LinkTls& tls);

}  // namespace grove::node
