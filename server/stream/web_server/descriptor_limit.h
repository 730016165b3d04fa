#pragma once

#include <cstddef>

namespace grove::stream {

/// Maximum number of sockets that a server serves at once.
inline constexpr std::size_t kMaxSockets = 256;

/// Returns how many sockets fit in the process's limit of open files, which it raises if necessary and possible; some
/// descriptors are reserved for files. Throws EnvironmentError if too few are left.
[[nodiscard]] std::size_t socketsThatFit();

}  // namespace grove::stream
