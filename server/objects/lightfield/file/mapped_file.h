#pragma once

#include <atomic>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>

#include "base/mapped_range_guard.h"

namespace grove::objects::lightfield {

/// A file's bytes, mapped read-only: pages are read when they are touched and shared by all processes. Writers that
/// replace the file (AtomicFile) are no harm. One that writes into it changes the bytes, and what is cut off reads as
/// zeros from then on.
class MappedFile {
 public:
  /// Throws EnvironmentError if the file cannot be opened or is no plain file.
  explicit MappedFile(const std::filesystem::path& file);
  ~MappedFile();
  MappedFile(const MappedFile&) = delete;
  MappedFile& operator=(const MappedFile&) = delete;

  [[nodiscard]] std::span<const std::byte> bytes() const noexcept { return bytes_; }

  /// Once something that was cut off has been read, says so in the log, once. Any thread; costs nothing otherwise.
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
