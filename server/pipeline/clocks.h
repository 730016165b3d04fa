#pragma once

#include <cstdint>

namespace grove::pipeline {

/// Nanoseconds of the monotonic clock.
[[nodiscard]] std::int64_t wallNanoseconds() noexcept;

/// Seconds of the same clock. It is also the clock of the worlds that this process owns; node::WorldMirror has the
/// clocks of others.
[[nodiscard]] inline double wallSeconds() noexcept { return static_cast<double>(wallNanoseconds()) * 1.0e-9; }

/// CPU time of the calling thread, nanoseconds.
[[nodiscard]] std::int64_t threadCpuNanoseconds() noexcept;

/// CPU time of the whole process, nanoseconds.
[[nodiscard]] std::int64_t processCpuNanoseconds() noexcept;

}  // namespace grove::pipeline
