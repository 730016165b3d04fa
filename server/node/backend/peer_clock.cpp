#include "node/backend/peer_clock.h"

#include <algorithm>

namespace grove::node {

void PeerClock::hear(double theirs, double ours) {
  ahead_.push_back(theirs - ours);
  if (ahead_.size() > kKept) ahead_.pop_front();
  offset_ = *std::ranges::max_element(ahead_);
}

std::optional<double> PeerClock::at(double ours) const {
  return ahead_.empty() ? std::nullopt : std::optional(ours + offset_);
}

}  // namespace grove::node
