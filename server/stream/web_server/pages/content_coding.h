#pragma once

#include <string_view>

namespace grove::stream {

/// How much a client wants a content coding ("gzip", "br" or "identity", in lower case), by its header Accept-Encoding
/// (RFC 9110, 12.5.3): thousandths, 0 if it does not take it. One that says nothing of identity takes it if need be.
/// Entries that cannot be read count for nothing.
[[nodiscard]] int codingWeight(std::string_view acceptEncoding, std::string_view coding) noexcept;

}  // namespace grove::stream
