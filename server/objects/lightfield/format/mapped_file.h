#pragma once

#include <cstddef>
#include <filesystem>
#include <span>

namespace grove::objects::lightfield {

/// A file's bytes, mapped read-only: pages are read when they are touched and shared by all processes. The file must
/// not be written to in place meanwhile; writers that replace it (AtomicFile) are no harm.
class MappedFile {
 public:
  /// Throws EnvironmentError if the file cannot be opened or is no plain file.
  explicit MappedFile(const std::filesystem::path& file);
  ~MappedFile();
  MappedFile(const MappedFile&) = delete;
  MappedFile& operator=(const MappedFile&) = delete;

  [[nodiscard]] std::span<const std::byte> bytes() const noexcept { return bytes_; }

 private:
  std::span<const std::byte> bytes_;
};

}  // namespace grove::objects::lightfield
