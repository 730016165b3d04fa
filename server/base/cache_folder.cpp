#include "base/cache_folder.h"

#include <cstdlib>
#include <string>

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

}  // namespace grove
