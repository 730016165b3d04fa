#pragma once

#include <netinet/in.h>

#include <optional>
#include <string_view>

namespace grove::stream {

/// Reads a numeric address, IPv4 or IPv6 (a zone as in fe80::1%eth0 counts for nothing); IPv4 comes as ::ffff:a.b.c.d.
[[nodiscard]] std::optional<in6_addr> parseAddress(std::string_view text);

/// Addresses that begin with the same bits.
class AddressRange {
 public:
  /// Reads one address, or `ADDRESS/BITS` (RFC 4632; RFC 4291, 2.3).
  [[nodiscard]] static std::optional<AddressRange> parse(std::string_view text);

  /// Whether this numeric address is one of them. What is no address is in no range.
  [[nodiscard]] bool contains(std::string_view address) const;

 private:
  AddressRange(const in6_addr& first, int bits) : first_(first), bits_(bits) {}

  in6_addr first_;
  int bits_;  ///< of 128
};

}  // namespace grove::stream
