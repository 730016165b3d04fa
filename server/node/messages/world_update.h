#pragma once

#include <cstdint>
#include <vector>

#include "world/edits.h"
#include "world/players.h"

namespace grove::node {

/// Visitors and their actions at one moment, thirty times a second while there are visitors. A frontend process sends
/// it to its backend nodes (WorldMirror accepts those of one process). If several frontend processes show one world,
/// each sends its own visitors to the world's owner, which responds with all visitors (WorldOwner).
struct WorldUpdate {
  std::uint64_t number = 0;  ///< counts up from 1
  double clock = 0.0;        ///< seconds of the world's clock
  double sent = 0.0;         ///< seconds of the sender's own clock, on which its frames have deadlines
  std::vector<world::Player> players;
  std::vector<world::Gust> gusts;  ///< gusts that blow now, or began and ended since the last update
};

}  // namespace grove::node
