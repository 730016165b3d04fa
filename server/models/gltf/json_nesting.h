#pragma once

#include <string_view>

namespace grove::models {

/// Whether more than `max` brackets of a JSON text are open at once. The glTF parser follows them by recursion, and
/// enough of them crash the program. This scan does not recurse. It stops where the outermost bracket closes, before a
/// binary file's buffer.
[[nodiscard]] bool nestsDeeper(std::string_view json, int max) noexcept;

}  // namespace grove::models
