#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

namespace grove {

/// A file that appears completely or not at all: written beside its place under another name, then renamed. One thread.
class AtomicFile {
 public:
  /// Throws EnvironmentError, as all members do, that names `file` and gives the system's reason.
  explicit AtomicFile(std::filesystem::path file);
  /// Removes what was written, unless committed.
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  /// Skipped bytes are 0.
  void write(std::uint64_t offset, std::span<const std::byte> bytes);
  /// Called once, last: afterwards the file is on the disk under its name, even after a power failure.
  void commit();

 private:
  [[noreturn]] void fail(const std::string& what) const;

  std::filesystem::path file_;
  std::string partial_;
  int descriptor_;
};

}  // namespace grove
