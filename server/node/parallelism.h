#pragma once

#include <cstdint>

namespace grove::node {

/// How many threads prepare a world.
enum class Parallelism : std::uint8_t {
  kAllCores,   ///< the workers help: no visitor needs them yet
  kOneThread,  ///< the calling thread alone, one step after the other: the workers serve visitors
};

}  // namespace grove::node
