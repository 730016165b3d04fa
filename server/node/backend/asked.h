#pragma once

#include <memory>

#include "node/backend/peer.h"
#include "node/messages/request.h"
#include "node/messages/result.h"

namespace grove::node {

/// A request on its way through a backend node, with who asks.
struct Asked {
  Request request;
  std::shared_ptr<Peer> peer;
};

/// Its result, on the way back.
struct Answered {
  Result result;
  std::shared_ptr<Peer> peer;
};

inline pipeline::TraceTag traceTag(const Asked& asked) { return traceTag(asked.request); }
inline pipeline::TraceTag traceTag(const Answered& answered) { return traceTag(answered.result); }

}  // namespace grove::node
