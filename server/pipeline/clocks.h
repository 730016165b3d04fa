#pragma once

#include <cstdint>

namespace grove::pipeline {

/// Nanoseconds of the monotonic clock.
[[nodiscard]] std::int64_t wallNanoseconds() noexcept;

/// Nanoseconds of CPU that the calling thread has used.
[[nodiscard]] std::int64_t threadCpuNanoseconds() noexcept;

/// Nanoseconds of CPU that the whole process has used.
[[nodiscard]] std::int64_t processCpuNanoseconds() noexcept;

}  // namespace grove::pipeline
