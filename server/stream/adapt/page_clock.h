#pragma once

#include <cstdint>

namespace grove::stream {

/// A page's clock, of which 32 bits of microseconds are reported: goes on over their end. One thread at a time.
class PageClock {
 public:
  /// Seconds since a moment that stays the same.
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
