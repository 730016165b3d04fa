#pragma once

#include <cstdint>
#include <memory>

#include "node/backend/peers/peer.h"
#include "node/messages/request.h"
#include "node/messages/result.h"

namespace grove::node {

/// The role of a result in a subscription of its peer.
enum class Subscribed : std::uint8_t {
  kNo,
  kBegins,  ///< the first answer
  kPushed,  ///< a later version, which the node itself requested
};

/// A request on its way through a backend node, with the requesting peer.
struct PeerRequest {
  Request request;
  std::shared_ptr<Peer> peer;
  Subscribed subscribed = Subscribed::kNo;
};

/// Its result, on the way back.
struct PeerResult {
  Result result;
  std::shared_ptr<Peer> peer;
  Subscribed subscribed = Subscribed::kNo;
};

/// The queue of a request: frontend processes take turns.
inline std::uint64_t lineOf(const PeerRequest& asked) { return asked.peer->process().value_or(0); }

inline pipeline::TraceTag traceTag(const PeerRequest& asked) { return traceTag(asked.request); }
inline pipeline::TraceTag traceTag(const PeerResult& answered) { return traceTag(answered.result); }

}  // namespace grove::node
