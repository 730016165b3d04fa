#pragma once

#include <string>

namespace grove::stream {

/// Where to listen, as numbers.
struct ListenAddress {
  std::string numeric;  ///< "127.0.0.1", "::1"
  bool isIpv6 = false;
};

/// Resolves a host name or address and tries that its port is free. Throws EnvironmentError saying how to mend it. A
/// port of 0 is any free one.
[[nodiscard]] ListenAddress findListenAddress(const std::string& host, int port);

}  // namespace grove::stream
