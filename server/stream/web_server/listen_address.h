#pragma once

#include <string>

namespace grove::stream {

/// Where to listen, as it was asked for.
struct HostPort {
  std::string host;
  int port = 0;
};

/// Where to listen, as numbers.
struct ListenAddress {
  std::string numeric;  ///< "127.0.0.1", "::1"
  bool isIpv6 = false;
};

/// Resolves a host name or address and tries that its port is free. Throws EnvironmentError saying how to mend it with
/// `option`. A port of 0 is any free one.
[[nodiscard]] ListenAddress findListenAddress(const std::string& host, int port, const std::string& option);

}  // namespace grove::stream
