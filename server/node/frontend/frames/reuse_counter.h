#pragma once

#include <map>

#include "node/frontend/visitor_halves.h"
#include "node/messages.h"
#include "pipeline/reuse.h"

namespace grove::node {

/// Counts how one visitor's frames use shared data that was made on demand, by type of object. One thread at a time.
class ReuseCounter {
 public:
  /// A frame of `session` gets this payload of an object.
  void used(world::TypeIndex type, const Payload& payload, SessionId session);

  /// Passes on what was counted since the last call: once for many uses, because all stages share the timeline.
  void report(pipeline::Timeline& timeline, const VisitorHalves& halves);

 private:
  std::map<world::TypeIndex, pipeline::Reuse> counted_;
};

}  // namespace grove::node
