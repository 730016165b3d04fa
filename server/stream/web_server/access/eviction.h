#pragma once

#include <optional>
#include <span>
#include <string_view>

namespace grove::stream {

/// A socket that may be closed to make room for a new one: no visitor in the world uses it.
struct Evictable {
  std::string_view owner;  ///< see guestOf(); empty: a proxy or this machine, which have sockets for many visitors
  double since = 0.0;      ///< when it was accepted, seconds
  bool isBusy = false;     ///< its request is being answered, or it waits for the world
};

/// Returns the index of the socket to close when places are short; nothing without sockets. Takes busy sockets last.
/// Otherwise takes the oldest socket of the owner with the most: an attacker has hundreds of silent sockets, whereas a
/// new visitor, silent for one round trip, has a few.
[[nodiscard]] std::optional<std::size_t> chooseEvicted(std::span<const Evictable> sockets);

}  // namespace grove::stream
