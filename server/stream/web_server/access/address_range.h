#pragma once

#include <netinet/in.h>

#include <optional>
#include <string_view>

namespace grove::stream {

/// Parses a numeric address, IPv4 or IPv6; ignores a zone as in fe80::1%eth0. IPv4 becomes ::ffff:a.b.c.d.
[[nodiscard]] std::optional<in6_addr> parseAddress(std::string_view text);

/// Addresses that begin with the same bits.
class AddressRange {
 public:
  /// Parses one address, or `ADDRESS/BITS` (RFC 4632; RFC 4291, 2.3).
  [[nodiscard]] static std::optional<AddressRange> parse(std::string_view text);

  /// Returns whether the range contains this numeric address; false for other text.
  [[nodiscard]] bool contains(std::string_view address) const;

 private:
  AddressRange(const in6_addr& first, int bits) : first_(first), bits_(bits) {}

  in6_addr first_;
  int bits_;  ///< of 128
};

}  // namespace grove::stream
