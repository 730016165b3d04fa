#pragma once

#include <string>
#include <vector>

namespace grove {

/// Names for a message: "a, b and 7 more", at most eight names of at most 64 bytes each, because a file may have any
/// number of any length. Line breaks and control characters become '?'.
[[nodiscard]] std::string nameList(const std::vector<std::string>& names);

}  // namespace grove
