#pragma once

#include <cstddef>
#include <span>

namespace grove {

/// Keeps the process alive when a file becomes shorter while it is mapped. Reading what is gone raises SIGBUS; within a
/// guarded range, zeros take the place of the rest of the range, and the reader goes on. Any other SIGBUS does what it
/// did before.
class MappedRangeGuard {
 public:
  /// `bytes` begin where mmap put them, and stay mapped for as long as this lives. Of more than 1024 ranges at once
  /// the last ones are not guarded.
  explicit MappedRangeGuard(std::span<const std::byte> bytes) noexcept;
  ~MappedRangeGuard();
  MappedRangeGuard(const MappedRangeGuard&) = delete;
  MappedRangeGuard& operator=(const MappedRangeGuard&) = delete;

  /// Whether a part of it has become zeros. Any thread; one load.
  [[nodiscard]] bool cut() const noexcept;

  struct Slot;

 private:
  Slot* slot_ = nullptr;
};

}  // namespace grove
