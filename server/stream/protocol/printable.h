#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace grove::stream {

/// Text from outside made safe to show and to log: what is not UTF-8 becomes '?', control characters and those that
/// turn the writing direction or have no width go, and blanks at both ends too. Cut to `maxBytes` between two
/// characters.
[[nodiscard]] std::string printable(std::string_view text, std::size_t maxBytes);

}  // namespace grove::stream
