#pragma once

#include <filesystem>

namespace grove::cli {

/// A folder of one's own that goes with what is in it. Files that are open or mapped live on.
class TemporaryFolder {
 public:
  /// Throws EnvironmentError.
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const noexcept { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace grove::cli
