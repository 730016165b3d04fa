#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

namespace grove::world {

/// The first line of a TOML file on which more than `most` brackets are open, or a name has more than `most` dots.
///
/// The parser makes a table of every part of a dotted name, and takes tables apart by recursion: a long enough name
/// ends the program. This scan does not recurse, and a text that passes has no value deeper than about most * most.
[[nodiscard]] std::optional<std::size_t> lineNestedDeeper(std::string_view text, int max);

}  // namespace grove::world
