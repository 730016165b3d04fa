#pragma once

#include <atomic>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>

#include "base/mapped_range_guard.h"

namespace grove::objects::lightfield {

/// A file's bytes, mapped read-only: pages are read on first access and shared by all processes. Replacing the file
/// (AtomicFile) is safe. Writing into the file changes the bytes, and truncated parts then read as zeros.
class MappedFile {
 public:
  /// Throws EnvironmentError if the file cannot be opened or is no regular file.
  explicit MappedFile(const std::filesystem::path& file);
  ~MappedFile();
  MappedFile(const MappedFile&) = delete;
  MappedFile& operator=(const MappedFile&) = delete;

  [[nodiscard]] std::span<const std::byte> bytes() const noexcept { return bytes_; }

  /// Leaves the pages that were read to the system's cache of files: they no longer count as this process's memory, and
  /// come back with the next access.
  void release() const noexcept;

  /// Logs once if a truncated part has been read. Any thread; free otherwise.
  void reportIfCut() const noexcept {
    if (guard_ && guard_->cut()) reportOnce();
  }

 private:
  void reportOnce() const noexcept;

  const std::string cutMessage_;
  std::span<const std::byte> bytes_;
  std::optional<MappedRangeGuard> guard_;
  mutable std::atomic<bool> reported_{false};
};

}  // namespace grove::objects::lightfield
