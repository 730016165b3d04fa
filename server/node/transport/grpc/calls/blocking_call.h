#pragma once

#include <grpcpp/support/status.h>

#include <chrono>
#include <optional>
#include <string>

#include "node/transport/grpc/tls/link_tls.h"

namespace grove::node {

/// A question to a node: to HOST:PORT, of a method, with the longest that the answer may take.
struct BlockingCall {
  std::string address;
  const char* method = "";
  std::chrono::milliseconds deadline{0};
};

/// How a call has ended.
struct CallEnd {
  grpc::Status status;
  bool wasOpen = false;                  ///< the node had taken it
  std::optional<std::string> complaint;  ///< why the node is not to be trusted; then nothing was said to it
  std::string answer;                    ///< where the status is good
};

/// Makes a call of one message each way, on a connection of its own, and returns at its end. Not on gRPC's
/// threads.
[[nodiscard]] CallEnd ask(const BlockingCall& call, const std::string& question, const LinkTls& tls);

}  // namespace grove::node
