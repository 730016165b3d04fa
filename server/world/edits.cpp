#include "world/edits.h"

#include <algorithm>
#include <utility>

namespace grove::world {

Gust gustOf(const Player& visitor) {
  Gust gust;
  gust.origin = visitor.pose.position;
  gust.direction = visitor.pose.forward();
  gust.visitor = visitor.id;
  return gust;
}

std::vector<Gust> gustsDuring(std::vector<Gust> clicks, std::span<const Player> visitors) {
  std::vector<Gust> gusts = std::move(clicks);
  for (const Player& visitor : visitors) {
    if ((visitor.keys & kBlow) == 0) continue;
    std::erase_if(gusts, [&](const Gust& gust) { return gust.visitor == visitor.id; });
    gusts.push_back(gustOf(visitor));
  }
  return gusts;
}

void Edits::add(const Gust& gust) {
  const std::lock_guard lock(mutex_);
  gusts_.push_back(gust);
  if (gusts_.size() > kCapacity) {
    gusts_.pop_front();
    ++first_;
  }
}

std::vector<Gust> Edits::after(Cursor& cursor) const {
  const std::lock_guard lock(mutex_);
  const Cursor from = std::max(cursor, first_);
  cursor = first_ + gusts_.size();
  return {gusts_.begin() + static_cast<std::ptrdiff_t>(from - first_), gusts_.end()};
}

}  // namespace grove::world
