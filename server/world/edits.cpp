#include "world/edits.h"

#include <algorithm>

namespace grove::world {

Gust gustOf(const Player& visitor) {
  Gust gust;
  gust.origin = visitor.pose.position;
  gust.direction = visitor.pose.forward();
  gust.visitor = visitor.id;
  return gust;
}

void Edits::startBlowing(const Player& visitor) {
  const std::lock_guard lock(mutex_);
  blowing_.insert(visitor.id);
  breaths_.push_back(gustOf(visitor));
  if (breaths_.size() > kCapacity) {
    breaths_.pop_front();
    ++first_;
  }
}

void Edits::stopBlowing(PlayerId visitor) {
  const std::lock_guard lock(mutex_);
  blowing_.erase(visitor);
}

std::vector<Gust> Edits::during(Cursor& cursor, std::span<const Player> visitors) const {
  const std::lock_guard lock(mutex_);
  const Cursor from = std::max(cursor, first_);
  cursor = first_ + breaths_.size();
  std::vector<Gust> gusts;
  std::set<PlayerId> known = blowing_;
  for (auto breath = breaths_.rbegin(); breath != breaths_.rend() - static_cast<std::ptrdiff_t>(from - first_);
       ++breath) {
    if (known.insert(breath->visitor).second) gusts.push_back(*breath);
  }
  std::ranges::reverse(gusts);
  for (const Player& visitor : visitors) {
    if (blowing_.contains(visitor.id)) gusts.push_back(gustOf(visitor));
  }
  return gusts;
}

}  // namespace grove::world
