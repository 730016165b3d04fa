#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

namespace grove {

/// A file that appears whole or not at all: written beside its place under another name, then renamed. One thread.
class AtomicFile {
 public:
  /// Throws EnvironmentError, as all of it does, that names `file` and what the system says.
  explicit AtomicFile(std::filesystem::path file);
  /// Unless committed, removes what was written.
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  /// Bytes that were skipped are 0.
  void write(std::uint64_t offset, std::span<const std::byte> bytes);
  /// Once, last: after this the file is on the disk under its name, also if the power fails.
  void commit();

 private:
  [[noreturn]] void fail(const std::string& what) const;

  std::filesystem::path file_;
  std::string partial_;
  int descriptor_;
};

}  // namespace grove
