#pragma once

#include <grpcpp/support/status.h>

#include <chrono>
#include <optional>
#include <string>

#include "node/transport/grpc/tls/link_tls.h"

namespace grove::node {

/// The target of a call: the node at HOST:PORT, the method, and the longest time for the response.
struct BlockingCall {
  std::string address;
  const char* method = "";
  std::chrono::milliseconds deadline{0};
};

/// The end of a call.
struct CallEnd {
  grpc::Status status;
  bool wasOpen = false;                  ///< the node had accepted the call
  std::optional<std::string> complaint;  ///< why the node's certificate is rejected; then nothing was sent
  std::string answer;                    ///< if the status is good
};

/// Makes a call of one message each way, on a connection of its own, and returns at its end. Must not run on gRPC's
/// threads.
[[nodiscard]] CallEnd ask(const BlockingCall& call, const std::string& question, const LinkTls& tls);

}  // namespace grove::node
