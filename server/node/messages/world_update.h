#pragma once

#include <cstdint>
#include <vector>

#include "world/edits.h"
#include "world/players.h"

namespace grove::node {

/// Who is in the world and what they do, as of one moment, thirty times a second while somebody is there. A frontend
/// process sends it to its backend nodes (see WorldMirror for whose counts). Where several frontend processes show one
/// world, each sends its own visitors to the world's owner, which answers with those of all (WorldOwner).
struct WorldUpdate {
  std::uint64_t number = 0;  ///< counts up from 1
  double clock = 0.0;        ///< seconds of the world's clock
  double sent = 0.0;         ///< seconds of the sender's own clock, by which its frames have deadlines
  std::vector<world::Player> players;
  std::vector<world::Gust> gusts;  ///< what blows now, or began and ended since the last update
};

}  // namespace grove::node
