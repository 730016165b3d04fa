#pragma once

#include <cstddef>

#include "node/transport/packets/packets.h"

/// What both ends of a gRPC link must agree on.
namespace grove::node {

/// A stream each way, one for each pair of frontend process and backend node.
inline constexpr const char* kLinkMethod = "/grove.node.v1.Node/Link";
/// A message each way: what a node without models asks one that has them.
inline constexpr const char* kObstaclesMethod = "/grove.node.v1.Node/Obstacles";
/// Such calls that a node serves at once, those that wait included.
inline constexpr int kMaxObstacleCalls = 32;
/// The longest that an answer may take: a node that is busy, and answers others before, may need seconds.
inline constexpr int kObstacleMilliseconds = 20'000;
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
