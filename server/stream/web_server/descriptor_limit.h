#pragma once

#include <cstddef>

namespace grove::stream {

/// So many sockets a server serves at once at most.
inline constexpr std::size_t kMaxSockets = 256;

/// For how many of them there is room in the process's limit of open files, which is raised as far as it may be if that
/// helps; some are kept back for files. Throws EnvironmentError if there is room for too few to serve anybody.
[[nodiscard]] std::size_t socketsThatFit();

}  // namespace grove::stream
