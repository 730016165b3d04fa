#include "cli/options/host_port.h"

#include <charconv>
#include <cstdio>

namespace grove::cli {

std::optional<stream::HostPort> parseHostPort(const std::string& text) {
  const std::size_t colon = text.rfind(':');
  if (colon == std::string::npos || colon == 0) return std::nullopt;
  stream::HostPort result;
  result.host = text.substr(0, colon);
  if (result.host.front() == '[' && result.host.back() == ']') {
    result.host = result.host.substr(1, result.host.size() - 2);
  } else if (result.host.find(':') != std::string::npos) {
    return std::nullopt;
  }
  const char* const begin = text.data() + colon + 1;
  const char* const end = text.data() + text.size();
  const auto [last, error] = std::from_chars(begin, end, result.port);
  if (begin == end || last != end || error != std::errc() || result.port < 0 || result.port > 65535) {
    return std::nullopt;
  }
  return result.host.empty() ? std::nullopt : std::optional(result);
}

std::optional<stream::HostPort> parseHostPort(const std::string& text, const char* option) {
  auto result = parseHostPort(text);
  if (!result) std::fprintf(stderr, "grove: %s wants HOST:PORT, not '%s'\n", option, text.c_str());
  return result;
}

std::string addressOf(const stream::HostPort& at, int port) {
  const bool isIpv6 = at.host.find(':') != std::string::npos;
  return (isIpv6 ? "[" + at.host + "]" : at.host) + ":" + std::to_string(port);
}

}  // namespace grove::cli
