#include "stream/web_server/access/address_range.h"

#include <arpa/inet.h>

#include <algorithm>
#include <charconv>
#include <string>

namespace grove::stream {
namespace {

constexpr int kAddressBits = 128;
constexpr int kIpv4Prefix = 96;

std::optional<int> parseBits(std::string_view text, int max) {
  int bits = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), bits);
  if (text.empty() || error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return bits >= 0 && bits <= max ? std::optional(bits) : std::nullopt;
}

}  // namespace

std::optional<in6_addr> parseAddress(std::string_view text) {
  // The text comes from outside: it may be long and contain zeros.
  if (text.size() > INET6_ADDRSTRLEN + 16 || text.find('\0') != std::string_view::npos) return std::nullopt;
  in6_addr six{};
  if (inet_pton(AF_INET6, std::string(text.substr(0, text.find('%'))).c_str(), &six) == 1) return six;
  in_addr four{};
  if (inet_pton(AF_INET, std::string(text).c_str(), &four) != 1) return std::nullopt;
  six.s6_addr[10] = six.s6_addr[11] = 0xFF;
  const auto* bytes = reinterpret_cast<const std::uint8_t*>(&four);
  std::copy(bytes, bytes + sizeof four, &six.s6_addr[12]);
  return six;
}

std::optional<AddressRange> AddressRange::parse(std::string_view text) {
  const std::size_t slash = text.find('/');
  const std::string_view first = text.substr(0, slash);
  const auto address = parseAddress(first);
  if (!address || first.find('%') != std::string_view::npos) return std::nullopt;
  if (slash == std::string_view::npos) return AddressRange(*address, kAddressBits);
  const int prefix = first.find(':') == std::string_view::npos ? kIpv4Prefix : 0;
  const auto bits = parseBits(text.substr(slash + 1), kAddressBits - prefix);
  if (!bits) return std::nullopt;
  return AddressRange(*address, prefix + *bits);
}

bool AddressRange::contains(std::string_view address) const {
  const auto other = parseAddress(address);
  if (!other) return false;
  const auto whole = static_cast<std::size_t>(bits_ / 8);
  if (!std::equal(first_.s6_addr, first_.s6_addr + whole, other->s6_addr)) return false;
  const int rest = bits_ % 8;
  return rest == 0 || ((first_.s6_addr[whole] ^ other->s6_addr[whole]) >> (8 - rest)) == 0;
}

}  // namespace grove::stream
