#pragma once

#include <string_view>

namespace grove::stream {

/// Returns the client's preference for a content coding ("gzip", "br" or "identity", in lower case) from its
/// Accept-Encoding header (RFC 9110, 12.5.3), in thousandths; 0 if the client does not accept it. A header that does
/// not mention identity accepts it with the lowest preference. Ignores malformed entries.
[[nodiscard]] int codingWeight(std::string_view acceptEncoding, std::string_view coding) noexcept;

}  // namespace grove::stream
