#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace grove::stream {

/// Makes text from outside safe to show and to log: replaces invalid UTF-8 by '?', and removes control characters,
/// characters without width or that change the writing direction, and blanks at both ends. Cuts the text to `maxBytes`
/// between two characters.
[[nodiscard]] std::string printable(std::string_view text, std::size_t maxBytes);

}  // namespace grove::stream
