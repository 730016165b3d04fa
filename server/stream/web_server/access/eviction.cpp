#include "stream/web_server/access/eviction.h"

#include <algorithm>
#include <tuple>
#include <unordered_map>

namespace grove::stream {

std::optional<std::size_t> chooseEvicted(std::span<const Evictable> sockets) {
  if (sockets.empty()) return std::nullopt;
  const bool allAreBusy = std::ranges::all_of(sockets, &Evictable::isBusy);
  std::unordered_map<std::string_view, int> held;
  for (const Evictable& socket : sockets) {
    if (socket.isBusy == allAreBusy && !socket.owner.empty()) ++held[socket.owner];
  }
  const auto rank = [&](const Evictable& socket) {
    const int others = socket.owner.empty() || socket.isBusy != allAreBusy ? 1 : held[socket.owner];
    return std::tuple(socket.isBusy, -others, socket.since);
  };
  return static_cast<std::size_t>(std::ranges::min_element(sockets, {}, rank) - sockets.begin());
}

}  // namespace grove::stream
