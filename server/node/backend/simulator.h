#pragma once

#include "node/backend/answerer.h"

namespace grove::node {

/// Answers with the simulation's newest data (section 4.2, step 5). The simulation itself ticks on its own clock,
/// independent of requests.
class Simulator final : public Answerer {
 public:
  Simulator(std::string_view subject, BackendHalf& half, const WorldMirror& world, const EndedFrames& ended,
            pipeline::Timeline& timeline)
      : Answerer("Simulator", subject, half, world, ended, timeline) {}
};

}  // namespace grove::node
