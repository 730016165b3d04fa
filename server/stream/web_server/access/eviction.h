#pragma once

#include <optional>
#include <span>
#include <string_view>

namespace grove::stream {

/// A socket that may be closed for a newcomer: nobody in the world has it.
struct Evictable {
  std::string_view owner;  ///< as of guestOf(); empty: a proxy's or this machine's, whose sockets are many guests'
  double since = 0.0;      ///< when it was accepted, seconds
  bool isBusy = false;     ///< it has sent a request that is being answered, or waits for the world
};

/// Which socket to close when places are short: an index, none if there is none. Busy ones go last. Of the others the
/// owner who has most loses the oldest: silent sockets go by the hundred, while a newcomer, who is silent for a round
/// trip, has a few.
[[nodiscard]] std::optional<std::size_t> chooseEvicted(std::span<const Evictable> sockets);

}  // namespace grove::stream
