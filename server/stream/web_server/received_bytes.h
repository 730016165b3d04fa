#pragma once

#include <cstdint>

namespace grove::stream {

/// Payload that a TCP socket has received since it was opened, control frames and all; 0 if it is not known. Any
/// thread.
[[nodiscard]] std::uint64_t receivedBytes(int socket) noexcept;

}  // namespace grove::stream
