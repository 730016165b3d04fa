#pragma once

#include <optional>
#include <string>

namespace grove::cli {

struct HostPort {
  std::string host;
  int port = 0;
};

/// Reads `HOST:PORT` with a port of 0 to 65535; `[::1]:80` for IPv6.
[[nodiscard]] std::optional<HostPort> parseHostPort(const std::string& text);

}  // namespace grove::cli
