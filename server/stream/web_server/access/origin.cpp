#include "stream/web_server/access/origin.h"

#include <arpa/inet.h>

#include <algorithm>
#include <charconv>
#include <utility>

namespace grove::stream {
namespace {

char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

bool equalsIgnoringCase(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](char x, char y) { return lower(x) == lower(y); });
}

std::string_view withoutPort(std::string_view host) {
  const bool isIpv6 = host.starts_with('[');
  const std::size_t colon = host.find(':', isIpv6 ? std::min(host.find(']'), host.size()) : 0);
  return host.substr(0, colon);
}

bool isAddress(const std::string& name) {
  in6_addr parsed{};
  if (name.starts_with('[') && name.ends_with(']')) {
    return inet_pton(AF_INET6, name.substr(1, name.size() - 2).c_str(), &parsed) == 1;
  }
  return inet_pton(AF_INET, name.c_str(), &parsed) == 1;
}

bool isPort(std::string_view text) {
  int port = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), port);
  return error == std::errc{} && end == text.data() + text.size() && port > 0 && port <= 65535;
}

}  // namespace

bool isKnownHost(std::string_view host, std::span<const std::string> names) {
  const std::string name(withoutPort(host));
  if (isAddress(name) || equalsIgnoringCase(name, "localhost")) return true;
  return std::ranges::any_of(names, [&](const std::string& known) { return equalsIgnoringCase(name, known); });
}

bool isSameOrigin(std::string_view origin, std::string_view host, std::optional<bool> isSecure) {
  const auto page = parseOrigin(origin);
  if (!page || host.empty()) return false;
  return (isSecure != true && *page == parseOrigin("http://" + std::string(host))) ||
         (isSecure != false && *page == parseOrigin("https://" + std::string(host)));
}

bool isOneOf(std::span<const std::string> origins, std::string_view origin) {
  return std::ranges::find(origins, parseOrigin(origin).value_or("")) != origins.end();
}

std::optional<std::string> parseOrigin(std::string_view text) {
  std::string origin(text);
  std::ranges::transform(origin, origin.begin(), lower);
  for (const auto& [scheme, defaultPort] : {std::pair("http://", ":80"), std::pair("https://", ":443")}) {
    if (!origin.starts_with(scheme)) continue;
    const std::string_view authority = std::string_view(origin).substr(std::string_view(scheme).size());
    const std::string_view host = withoutPort(authority);
    if (!isHostName(host) && !isAddress(std::string(host))) return std::nullopt;
    const std::string_view port = authority.substr(host.size());
    if (!port.empty() && !isPort(port.substr(1))) return std::nullopt;
    if (port == defaultPort) origin.resize(origin.size() - port.size());
    return origin;
  }
  return std::nullopt;
}

bool isHostName(std::string_view text) {
  const auto isAllowed = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '.' ||
           c == '_';
  };
  return !text.empty() && std::ranges::all_of(text, isAllowed);
}

}  // namespace grove::stream
