#include "stream/load/load_target.h"

#include <charconv>
#include <string_view>
#include <system_error>

namespace grove::stream {

std::optional<LoadTarget> parseLoadUrl(const std::string& url) {
  constexpr std::string_view kScheme = "ws://";
  constexpr std::string_view kSecureScheme = "wss://";
  LoadTarget target;
  target.isSecure = url.starts_with(kSecureScheme);
  if (target.isSecure) target.port = 443;
  if (!target.isSecure && !url.starts_with(kScheme)) return std::nullopt;
  std::string_view rest = url;
  rest.remove_prefix(target.isSecure ? kSecureScheme.size() : kScheme.size());
  if (rest.ends_with('/')) rest.remove_suffix(1);
  if (rest.find('/') != std::string_view::npos) return std::nullopt;
  const std::size_t bracket = rest.rfind(']');
  const std::size_t colon = rest.rfind(':');
  if (colon != std::string_view::npos && (bracket == std::string_view::npos || colon > bracket)) {
    const std::string_view port = rest.substr(colon + 1);
    const auto [end, error] = std::from_chars(port.data(), port.data() + port.size(), target.port);
    if (error != std::errc{} || end != port.data() + port.size()) return std::nullopt;
    rest = rest.substr(0, colon);
  }
  if (rest.starts_with('[') && rest.ends_with(']')) rest = rest.substr(1, rest.size() - 2);
  if (rest.empty() || target.port < 1 || target.port > 65535) return std::nullopt;
  target.host = rest;
  return target;
}

}  // namespace grove::stream
