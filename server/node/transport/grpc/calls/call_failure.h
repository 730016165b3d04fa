#pragma once

#include <grpcpp/support/status.h>

#include <cstdint>
#include <string>

namespace grove::node {

/// The reason for the end of a call to a node.
struct CallFailure {
  enum class Kind : std::uint8_t {
    kNoAnswer,
    kMayWantTls,  ///< the node closes connections without TLS
    kRefused,     ///< by the node
    kUntrusted,   ///< the node does not speak TLS
    kSilent,      ///< the node accepted the connection, and this process closed it
  };
  Kind kind = Kind::kNoAnswer;
  std::string reason;
};

/// `wasOpen`: the node had accepted the call. `isSecure`: over TLS.
[[nodiscard]] CallFailure failureOf(const grpc::Status& status, bool wasOpen, bool isSecure);

}  // namespace grove::node
