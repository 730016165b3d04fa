#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <string>

#include "node/messages/ids.h"

namespace grove::node {

/// Bytes by which an object type names one of its shared data; only the type interprets them. Empty: the object's own
/// data, of which there is one.
using Key = std::string;
inline constexpr std::size_t kMaxKeyBytes = 128;

/// Names shared data within a world.
struct SharedKey {
  world::ObjectId object = 0;
  Key key;
  friend auto operator<=>(const SharedKey&, const SharedKey&) = default;  // NOLINT(modernize-use-nullptr): its own 0
};

/// Data under a key changes by getting a higher version.
using Version = std::uint32_t;

}  // namespace grove::node
