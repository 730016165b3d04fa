#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>

namespace grove::objects::mesh {

/// An empty cache folder for one test, removed at its end.
class TemporaryCache {
 public:
  TemporaryCache() {
    std::string name = (std::filesystem::temp_directory_path() / "grove_cache_XXXXXX").string();
    path_ = mkdtemp(name.data());
    const char* const former = std::getenv("GROVE_CACHE");
    former_ = former != nullptr ? former : "";
    setenv("GROVE_CACHE", path_.c_str(), 1);
  }
  ~TemporaryCache() {
    setenv("GROVE_CACHE", former_.c_str(), 1);
    std::filesystem::remove_all(path_);
  }
  TemporaryCache(const TemporaryCache&) = delete;
  TemporaryCache& operator=(const TemporaryCache&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const noexcept { return path_; }

 private:
  std::filesystem::path path_;
  std::string former_;
};

}  // namespace grove::objects::mesh
