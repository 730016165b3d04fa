#pragma once

#include "node/backend/request_handler.h"

namespace grove::node {

/// Returns the simulation's newest data (section 4.2, step 5). The simulation ticks on its own clock, independent of
/// requests.
class Simulator final : public RequestHandler {
 public:
  Simulator(std::string_view subject, BackendHalf& half, pipeline::Timeline& timeline)
      : RequestHandler("Simulator", subject, half, timeline) {}
};

}  // namespace grove::node
