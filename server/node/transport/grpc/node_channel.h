#pragma once

#include <grpcpp/channel.h>

#include <memory>
#include <string>

#include "node/transport/grpc/tls/link_tls.h"

namespace grove::node {

/// Makes a channel to the node at HOST:PORT, with a connection of its own, which the first call opens.
[[nodiscard]] std::shared_ptr<grpc::Channel> channelTo(const std::string& address, const LinkTls& tls);

}  // namespace grove::node
