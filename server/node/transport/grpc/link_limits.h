#pragma once

#include <cstddef>

#include "node/transport/packets.h"

/// What both ends of a gRPC link must agree on.
namespace grove::node {

/// The only method: a stream each way, one for each pair of frontend process and backend node.
inline constexpr const char* kLinkMethod = "/grove.node.v1.Node/Link";
/// Of one message. It fits into a queue that is not half full.
inline constexpr std::size_t kMaxMessageBytes = kMaxWaitingBytes / 2;
/// A link on which nothing comes is asked for a sign of life, and is lost without one.
inline constexpr int kKeepAliveMilliseconds = 5000;
inline constexpr int kKeepAliveTimeoutMilliseconds = 3000;
/// A node that neither welcomes nor refuses within this time is called again.
inline constexpr int kAnswerMilliseconds = 5000;
/// A link that brings bytes, but no answer within this time, is lost, too.
inline constexpr int kSilenceMilliseconds = kKeepAliveMilliseconds + kKeepAliveTimeoutMilliseconds;

}  // namespace grove::node
