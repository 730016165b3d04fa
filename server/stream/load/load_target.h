#pragma once

#include <optional>
#include <string>

namespace grove::stream {

/// Where a load test goes.
struct LoadTarget {
  std::string host;
  int port = 80;
  bool isSecure = false;             ///< by TLS; its certificate is checked
  bool takesAnyCertificate = false;  ///< it is not
};

/// Reads `ws[s]://HOST[:PORT][/]`; nothing if it is something else.
[[nodiscard]] std::optional<LoadTarget> parseLoadUrl(const std::string& url);

}  // namespace grove::stream
