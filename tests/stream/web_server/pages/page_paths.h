#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "pipeline/embedded.h"

namespace grove::stream {

inline bool isCompressed(std::string_view file) { return file.ends_with(".gz") || file.ends_with(".br"); }

/// Those of the embedded pages.
inline std::vector<std::string> pagePaths() {
  std::vector<std::string> paths;
  for (const embedded::File& file : embedded::web()) {
    if (!isCompressed(file.path)) paths.push_back(std::string("/") + file.path);
  }
  return paths;
}

/// Of the one of this name: its folder's name is a hash. Empty if there is none.
inline std::string pathOf(const std::string& name) {
  const auto paths = pagePaths();
  const auto found = std::ranges::find_if(paths, [&](const std::string& path) { return path.ends_with("/" + name); });
  return found == paths.end() ? "" : *found;
}

}  // namespace grove::stream
