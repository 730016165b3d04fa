#pragma once

#include <cstdint>

#include "world/object.h"
#include "world/players.h"

/// Names of what messages are about. Those of sessions and players are distinct between frontend processes.
namespace grove::node {

/// The frontend process's own number in the high half, see makeId(), a count from 1 in the low one.
using SessionId = std::uint64_t;
using FrameNumber = std::uint32_t;
using ProcessId = std::uint32_t;

[[nodiscard]] constexpr std::uint64_t makeId(ProcessId process, std::uint32_t number) noexcept {
  return std::uint64_t{process} << 32U | number;
}
/// Whose an id is.
[[nodiscard]] constexpr ProcessId processOf(std::uint64_t id) noexcept { return static_cast<ProcessId>(id >> 32U); }
/// What tells the sessions of one process apart, for people and traces.
[[nodiscard]] constexpr std::uint32_t numberOf(std::uint64_t id) noexcept { return static_cast<std::uint32_t>(id); }

}  // namespace grove::node
