#pragma once

#include <cstdint>

namespace grove::stream {

/// Returns the payload bytes that a TCP socket has received since it was opened, including control frames; 0 if
/// unknown. Any thread.
[[nodiscard]] std::uint64_t receivedBytes(int socket) noexcept;

}  // namespace grove::stream
