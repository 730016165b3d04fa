#pragma once

#include <cstdint>

namespace grove::stream {

/// The users of a listener: visitors, or the operator of the server.
enum class Audience : std::uint8_t { kVisitors, kOperator };

}  // namespace grove::stream
