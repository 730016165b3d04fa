#pragma once

#include <filesystem>

namespace grove::cli {

/// A temporary folder, deleted with its contents by the destructor. Open or mapped files stay usable.
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
