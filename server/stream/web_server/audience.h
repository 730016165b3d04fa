#pragma once

#include <cstdint>

namespace grove::stream {

/// Who a listener is for: everybody, or who runs the server.
enum class Audience : std::uint8_t { kVisitors, kOperator };

}  // namespace grove::stream
