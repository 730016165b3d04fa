#pragma once

#include <filesystem>

namespace grove {

/// Where what can be made again is kept: $GROVE_CACHE, else $XDG_CACHE_HOME/grove, else ~/.cache/grove.
[[nodiscard]] std::filesystem::path cacheFolder();

/// It, or a folder in it, if it is not there. Throws EnvironmentError.
void makeCacheFolder(const std::filesystem::path& folder);

}  // namespace grove
