#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

namespace grove::world {

/// Returns the first line of a TOML file on which more than `max` brackets are open, or a name has more than `max`
/// dots.
///
/// The parser makes a table of every part of a dotted name, and destroys tables by recursion: a long enough name
/// crashes the program. This scan does not recurse, and a text that passes has no value deeper than about max * max.
[[nodiscard]] std::optional<std::size_t> lineNestedDeeper(std::string_view text, int max);

}  // namespace grove::world
