#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

namespace grove::objects::figure {

/// The code points of UTF-8 text, U+FFFD for every byte that belongs to none.
[[nodiscard]] std::vector<std::uint32_t> decodeUtf8(std::string_view text);

}  // namespace grove::objects::figure
