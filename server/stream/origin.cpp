#include "stream/origin.h"

#include <arpa/inet.h>

#include <algorithm>

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

}  // namespace

bool isKnownHost(std::string_view host, std::span<const std::string> names) {
  const std::string name(withoutPort(host));
  if (isAddress(name) || equalsIgnoringCase(name, "localhost")) return true;
  return std::ranges::any_of(names, [&](const std::string& known) { return equalsIgnoringCase(name, known); });
}

bool isSameOrigin(std::string_view origin, std::string_view host) {
  for (const std::string_view scheme : {"http://", "https://"}) {
    if (equalsIgnoringCase(origin.substr(0, scheme.size()), scheme)) {
      return !host.empty() && equalsIgnoringCase(origin.substr(scheme.size()), host);
    }
  }
  return false;
}

}  // namespace grove::stream
