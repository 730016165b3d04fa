#include "base/cache_folder.h"

#include <cstdlib>
#include <string>
#include <system_error>

#include "base/error.h"

namespace grove {
namespace {

std::string environment(const char* name) {
  const char* value = std::getenv(name);
  return value != nullptr ? value : "";
}

}  // namespace

std::filesystem::path cacheFolder() {
  if (const std::string chosen = environment("GROVE_CACHE"); !chosen.empty()) return chosen;
  if (const std::string xdg = environment("XDG_CACHE_HOME"); !xdg.empty()) return std::filesystem::path(xdg) / "grove";
  return std::filesystem::path(environment("HOME")) / ".cache" / "grove";
}

void makeCacheFolder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) {
    throw EnvironmentError("cannot make a folder of the cache: " + error.message(), folder.string(),
                           "set GROVE_CACHE to a folder that can be written");
  }
}

}  // namespace grove
