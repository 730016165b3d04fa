#pragma once

#include <cstddef>

#include "node/transport/packets/packets.h"

/// Values that both ends of a gRPC link must share.
namespace grove::node {

/// A stream each way, one per pair of frontend process and backend node.
inline constexpr const char* kLinkMethod = "/grove.node.v1.Node/Link";
/// A message each way: the request of a node without models to a node with models.
inline constexpr const char* kObstaclesMethod = "/grove.node.v1.Node/Obstacles";
/// Calls that a node serves at once, waiting ones included.
inline constexpr int kMaxObstacleCalls = 32;
/// The longest time for a response: a busy node that serves other calls first may need seconds.
inline constexpr int kObstacleMilliseconds = 20'000;
/// Of one message. It fits into a queue that is not half full.
inline constexpr std::size_t kMaxMessageBytes = kMaxWaitingBytes / 2;
/// A link without traffic gets a ping after this time, and is lost without a response.
inline constexpr int kKeepAliveMilliseconds = 5000;
inline constexpr int kKeepAliveTimeoutMilliseconds = 3000;
/// A node that neither welcomes nor refuses within this time is called again.
inline constexpr int kAnswerMilliseconds = 5000;
/// A link that carries bytes but no response within this time is lost, too.
inline constexpr int kSilenceMilliseconds = kKeepAliveMilliseconds + kKeepAliveTimeoutMilliseconds;

}  // namespace grove::node
