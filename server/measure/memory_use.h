#pragma once

#include <sys/types.h>

#include <cstddef>
#include <cstdint>

namespace grove::measure {

/// Physical memory of a process, bytes.
struct MemoryUse {
  std::int64_t resident = 0;      ///< includes mapped files
  std::int64_t proportional = 0;  ///< counts only its share of pages that other processes map, too

  /// Throws EnvironmentError if the system does not report it.
  [[nodiscard]] static MemoryUse read();
  /// Of another process of this user. Throws EnvironmentError if it does not exist.
  [[nodiscard]] static MemoryUse of(pid_t process);
};

/// Returns MemoryUse::resident alone, in microseconds instead of milliseconds; 0 if the system does not report it.
[[nodiscard]] std::size_t residentBytes();

/// Returns the bytes that programs can allocate without swapping. Throws EnvironmentError if the system does not report
/// it.
[[nodiscard]] std::int64_t availableMemory();

/// Returns freed memory to the system, so that earlier allocations do not count as held.
void returnFreedMemory();

}  // namespace grove::measure
