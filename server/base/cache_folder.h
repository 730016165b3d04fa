#pragma once

#include <filesystem>

namespace grove {

/// Where what can be made again is kept: $GROVE_CACHE, else $XDG_CACHE_HOME/grove, else ~/.cache/grove.
[[nodiscard]] std::filesystem::path cacheFolder();

}  // namespace grove
