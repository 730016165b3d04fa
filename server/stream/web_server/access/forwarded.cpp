#include "stream/web_server/access/forwarded.h"

#include <algorithm>
#include <cctype>

namespace grove::stream {
namespace {

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kBlanks = " \t";
  const std::size_t begin = std::min(text.find_first_not_of(kBlanks), text.size());
  return text.substr(begin, text.find_last_not_of(kBlanks) + 1 - begin);
}

/// An address without port and brackets: "1.2.3.4:5", "[::1]:5", "[::1]", "::1".
std::string_view addressOf(std::string_view entry) {
  if (entry.starts_with('[')) {
    const std::size_t end = entry.find(']');
    if (end == std::string_view::npos) return {};
    const std::string_view behind = entry.substr(end + 1);
    return behind.empty() || behind.starts_with(':') ? entry.substr(1, end - 1) : std::string_view();
  }
  const std::size_t colon = entry.find(':');
  const bool hasPort = colon != std::string_view::npos && entry.find(':', colon + 1) == std::string_view::npos;
  return hasPort ? entry.substr(0, colon) : entry;
}

}  // namespace

bool isProxy(std::string_view address, std::span<const AddressRange> proxies) {
  return std::ranges::any_of(proxies, [&](const AddressRange& range) { return range.contains(address); });
}

std::string visitorBehind(const std::string& proxy, std::string_view forwardedFor,
                          std::span<const AddressRange> proxies) {
  std::string_view nearest = proxy;
  while (isProxy(nearest, proxies) && !forwardedFor.empty()) {
    const std::string_view address = addressOf(lastEntry(forwardedFor));
    if (!parseAddress(address)) break;
    nearest = address;
    const std::size_t comma = forwardedFor.rfind(',');
    forwardedFor = forwardedFor.substr(0, comma == std::string_view::npos ? 0 : comma);
  }
  return std::string(nearest);
}

bool isSecureScheme(std::string_view scheme) {
  std::string lower(scheme);
  std::ranges::transform(lower, lower.begin(), [](unsigned char c) { return std::tolower(c); });
  return lower == "https" || lower == "wss";
}

std::string_view lastEntry(std::string_view list) {
  const std::size_t comma = list.rfind(',');
  return trimmed(comma == std::string_view::npos ? list : list.substr(comma + 1));
}

}  // namespace grove::stream
