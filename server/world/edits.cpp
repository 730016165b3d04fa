#include "world/edits.h"

#include <algorithm>

namespace grove::world {

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
