#pragma once

#include <cstdint>
#include <vector>

#include "world/edits.h"
#include "world/players.h"

namespace grove::node {

/// What backend nodes know of who is in the world and what they do, as of one moment. The owner of the world sends it
/// to every node, thirty times a second while somebody is there; see WorldMirror for who that is.
struct WorldUpdate {
  std::uint64_t number = 0;  ///< counts up from 1
  double clock = 0.0;        ///< seconds of the world's clock
  std::vector<world::Player> players;
  std::vector<world::Gust> gusts;  ///< what blows now, or began and ended since the last update
};

}  // namespace grove::node
