#pragma once

#include <cstdint>

#include "pipeline/timeline.h"
#include "world/object.h"
#include "world/players.h"

/// Ids in messages. Ids of sessions and players differ between frontend processes.
namespace grove::node {

/// The frontend process's number in the high half, see makeId(), a count from 1 in the low one.
using SessionId = std::uint64_t;
using FrameNumber = std::uint32_t;
using ProcessId = std::uint32_t;

[[nodiscard]] constexpr std::uint64_t makeId(ProcessId process, std::uint32_t number) noexcept {
  return std::uint64_t{process} << 32U | number;
}
/// The process that made an id.
[[nodiscard]] constexpr ProcessId processOf(std::uint64_t id) noexcept { return static_cast<ProcessId>(id >> 32U); }
/// A player in 32 bits, for the pages of process `own`: the count for its own players, a hash for others.
[[nodiscard]] constexpr std::uint32_t shortIdOf(world::PlayerId id, ProcessId own) noexcept {
  constexpr std::uint32_t kForeign = 1U << 31U;
  if (processOf(id) == own) return static_cast<std::uint32_t>(id);
  return kForeign | static_cast<std::uint32_t>(id * 0x9E3779B97F4A7C15U >> 33U);
}
/// The count within its process, for log lines and traces.
[[nodiscard]] constexpr std::uint32_t numberOf(std::uint64_t id) noexcept { return static_cast<std::uint32_t>(id); }
[[nodiscard]] constexpr pipeline::TraceTag traceTag(SessionId session, FrameNumber frame) noexcept {
  return {numberOf(session), frame, processOf(session)};
}

}  // namespace grove::node
