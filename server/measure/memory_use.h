#pragma once

#include <sys/types.h>

#include <cstddef>
#include <cstdint>

namespace grove::measure {

/// What the process really holds of the machine's memory, in bytes.
struct MemoryUse {
  std::int64_t resident = 0;      ///< mapped files included
  std::int64_t proportional = 0;  ///< with its share only of what other processes have mapped, too

  /// Throws EnvironmentError if the system does not report it.
  [[nodiscard]] static MemoryUse read();
  /// Of another process of this user. Throws EnvironmentError if it does not exist.
  [[nodiscard]] static MemoryUse of(pid_t process);
};

/// MemoryUse::resident alone, which takes microseconds where the rest takes milliseconds. 0 if the system does not
/// tell.
[[nodiscard]] std::size_t residentBytes();

/// Bytes that programs may still take without swapping. Throws EnvironmentError if the system does not report it.
[[nodiscard]] std::int64_t availableMemory();

/// Gives back to the system what was freed, so that what was held before does not count as held now.
void returnFreedMemory();

}  // namespace grove::measure
