#pragma once

#include <optional>
#include <string>

#include "stream/web_server/listen_address.h"

namespace grove::cli {

/// Reads `HOST:PORT` with a port of 0 to 65535; `[::1]:80` for IPv6.
[[nodiscard]] std::optional<stream::HostPort> parseHostPort(const std::string& text);

}  // namespace grove::cli
