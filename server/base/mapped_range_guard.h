#pragma once

#include <cstddef>
#include <span>

namespace grove {

/// Keeps the process alive when a file becomes shorter while it is mapped. Reading the missing part raises SIGBUS;
/// within a guarded range, zeros replace the rest of the range and the reader continues. Any other SIGBUS has its
/// previous effect.
class MappedRangeGuard {
 public:
  /// `bytes` begin where mmap put them, and stay mapped during this object's life. If there are more than 1024 ranges,
  /// the last ones are not guarded.
  explicit MappedRangeGuard(std::span<const std::byte> bytes) noexcept;
  ~MappedRangeGuard();
  MappedRangeGuard(const MappedRangeGuard&) = delete;
  MappedRangeGuard& operator=(const MappedRangeGuard&) = delete;

  /// Whether a part of it was replaced by zeros. Any thread; one load.
  [[nodiscard]] bool cut() const noexcept;

  struct Slot;

 private:
  Slot* slot_ = nullptr;
};

}  // namespace grove
