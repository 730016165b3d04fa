#pragma once

#include <optional>
#include <string>

namespace grove::stream {

/// The server that a load test visits.
struct LoadTarget {
  std::string host;
  int port = 80;
  bool isSecure = false;             ///< TLS; the certificate is verified
  bool takesAnyCertificate = false;  ///< skips the verification
};

/// Parses `ws[s]://HOST[:PORT][/]`; nothing if the text is something else.
[[nodiscard]] std::optional<LoadTarget> parseLoadUrl(const std::string& url);

}  // namespace grove::stream
