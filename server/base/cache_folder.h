#pragma once

#include <filesystem>

namespace grove {

/// The folder of data that can be made again: $GROVE_CACHE, else $XDG_CACHE_HOME/grove, else ~/.cache/grove.
[[nodiscard]] std::filesystem::path cacheFolder();

/// Makes the cache folder, or a folder in it, if it is missing. Throws EnvironmentError.
void makeCacheFolder(const std::filesystem::path& folder);

}  // namespace grove
