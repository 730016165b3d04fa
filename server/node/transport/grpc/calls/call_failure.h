#pragma once

#include <grpcpp/support/status.h>

#include <cstdint>
#include <string>

namespace grove::node {

/// Why a call to a node has ended, in our words.
struct CallFailure {
  enum class Kind : std::uint8_t {
    kNoAnswer,
    kMayWantTls,  ///< it closes connections in the clear
    kRefused,     ///< by the node
    kUntrusted,   ///< it does not speak TLS
    kSilent,      ///< it has taken the connection, and this process has given it up
  };
  Kind kind = Kind::kNoAnswer;
  std::string reason;
};

/// `wasOpen`: the node had taken the call. `isSecure`: over TLS.
[[nodiscard]] CallFailure failureOf(const grpc::Status& status, bool wasOpen, bool isSecure);

}  // namespace grove::node
