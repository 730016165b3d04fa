#include "node/transport/peer_clock.h"

#include <algorithm>
#include <cmath>

namespace grove::node {

void PeerClock::addReport(double theirs, double ours) {
  const double ahead = theirs - ours;
  if (!ahead_.empty() && std::abs(ahead - offset_) > kJump) {
    const bool isAgain = doubted_ && std::abs(ahead - *doubted_) <= kJump;
    doubted_ = ahead;
    if (!isAgain) return;
    ahead_.clear();
  }
  doubted_.reset();
  ahead_.push_back(ahead);
  if (ahead_.size() > kKept) ahead_.pop_front();
  offset_ = *std::ranges::max_element(ahead_);
}

std::optional<double> PeerClock::at(double ours) const {
  return ahead_.empty() ? std::nullopt : std::optional(ours + offset_);
}

}  // namespace grove::node
