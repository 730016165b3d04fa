#pragma once

#include <string>

namespace grove::stream {

/// Where to listen, as the user gives it.
struct HostPort {
  std::string host;
  int port = 0;
};

/// Where to listen, resolved.
struct ListenAddress {
  std::string numeric;  ///< "127.0.0.1", "::1"
  bool isIpv6 = false;
};

/// Resolves a host name or address and checks that its port is free; port 0 is any free one. Throws EnvironmentError
/// with advice on how to set `option`.
[[nodiscard]] ListenAddress findListenAddress(const std::string& host, int port, const std::string& option);

}  // namespace grove::stream
