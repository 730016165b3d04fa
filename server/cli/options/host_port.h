#pragma once

#include <optional>
#include <string>

#include "stream/web_server/listen_address.h"

namespace grove::cli {

/// Parses `HOST:PORT` with a port of 0 to 65535; `[::1]:80` for IPv6.
[[nodiscard]] std::optional<stream::HostPort> parseHostPort(const std::string& text);
/// The same of an option's value, with a line on stderr if it is no address.
[[nodiscard]] std::optional<stream::HostPort> parseHostPort(const std::string& text, const char* option);

/// Formats the address with another port: `[::1]:8090` for IPv6.
[[nodiscard]] std::string addressOf(const stream::HostPort& at, int port);

}  // namespace grove::cli
