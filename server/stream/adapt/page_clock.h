#pragma once

#include <cstdint>

namespace grove::stream {

/// Extends a page's clock, reported as 32 bits of microseconds, beyond their overflow. Not thread-safe.
class PageClock {
 public:
  /// Returns seconds since a fixed moment.
  [[nodiscard]] double seconds(std::uint32_t microseconds) {
    seconds_ += static_cast<double>(static_cast<std::int32_t>(microseconds - last_)) * 1e-6;
    last_ = microseconds;
    return seconds_;
  }

 private:
  std::uint32_t last_ = 0;
  double seconds_ = 0.0;
};

}  // namespace grove::stream
