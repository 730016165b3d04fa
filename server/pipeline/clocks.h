#pragma once

#include <cstdint>

namespace grove::pipeline {

/// Nanoseconds of the monotonic clock.
[[nodiscard]] std::int64_t wallNanoseconds() noexcept;

/// Seconds of the same clock. It is also the clock of the worlds that this process owns; of those that another owns, a
/// node::WorldMirror knows it.
[[nodiscard]] inline double wallSeconds() noexcept { return static_cast<double>(wallNanoseconds()) * 1.0e-9; }

/// Nanoseconds of CPU that the calling thread has used.
[[nodiscard]] std::int64_t threadCpuNanoseconds() noexcept;

/// Nanoseconds of CPU that the whole process has used.
[[nodiscard]] std::int64_t processCpuNanoseconds() noexcept;

}  // namespace grove::pipeline
