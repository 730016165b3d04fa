#include "stream/origin.h"

#include <algorithm>

namespace grove::stream {
namespace {

char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

bool equalsIgnoringCase(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](char x, char y) { return lower(x) == lower(y); });
}

}  // namespace

bool isSameOrigin(std::string_view origin, std::string_view host) {
  for (const std::string_view scheme : {"http://", "https://"}) {
    if (equalsIgnoringCase(origin.substr(0, scheme.size()), scheme)) {
      return !host.empty() && equalsIgnoringCase(origin.substr(scheme.size()), host);
    }
  }
  return false;
}

}  // namespace grove::stream
