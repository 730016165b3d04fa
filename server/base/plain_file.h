#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

namespace grove {

/// A plain file, opened for reading. Refuses other kinds without reading: a device may never end, a pipe never begin.
/// One thread.
class PlainFile {
 public:
  /// Throws EnvironmentError, as all members do, that ends with `mend`; also for a file of more than `maxBytes`.
  PlainFile(std::filesystem::path file, std::string mend, std::uint64_t maxBytes);
  ~PlainFile();
  PlainFile(const PlainFile&) = delete;
  PlainFile& operator=(const PlainFile&) = delete;

  [[nodiscard]] int descriptor() const noexcept { return descriptor_; }
  /// Its length when it was opened.
  [[nodiscard]] std::uint64_t bytes() const noexcept { return bytes_; }

  /// Reads the next bytes; fewer than requested only at the end.
  [[nodiscard]] std::size_t read(std::span<char> to);
  /// Reads the rest of bytes().
  [[nodiscard]] std::string readAll();

 private:
  [[noreturn]] void fail(const std::string& what) const;

  const std::filesystem::path file_;
  const std::string mend_;
  int descriptor_;
  std::uint64_t bytes_ = 0;
};

}  // namespace grove
