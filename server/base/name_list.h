#pragma once

#include <string>
#include <vector>

namespace grove {

/// Names for a message: "a, b and 7 more", the first eight of them and of each no more than 64 bytes, for a file may
/// have any number of any length. What would begin a new line, or what a terminal would obey, becomes '?'.
[[nodiscard]] std::string nameList(const std::vector<std::string>& names);

}  // namespace grove
