#pragma once

#include <string_view>

namespace grove::models {

/// Whether more than `most` brackets of a JSON text are open anywhere. The glTF parser follows them by recursion:
/// enough of them end the program. This scan does not recurse. In what follows the JSON (a binary file's buffer), it
/// stops where the outermost bracket was closed.
[[nodiscard]] bool nestsDeeper(std::string_view json, int max) noexcept;

}  // namespace grove::models
