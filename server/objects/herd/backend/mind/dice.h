#pragma once

#include <cstddef>
#include <cstdint>

#include "world/noise.h"

namespace grove::objects::herd {

/// Random numbers that are the same on every machine.
class Dice {
 public:
  explicit Dice(std::uint32_t seed) : state_(world::hash(seed + 0x9E3779B9U)) {}

  /// 0 to before 1.
  [[nodiscard]] float share() {
    state_ += 0x9E3779B9U;
    return static_cast<float>(world::hash(state_) >> 8U) * (1.0F / 16777216.0F);
  }
  [[nodiscard]] float between(float low, float high) { return low + (high - low) * share(); }
  /// 0 to `count` - 1.
  [[nodiscard]] std::size_t index(std::size_t count) {
    return static_cast<std::size_t>(share() * static_cast<float>(count)) % count;
  }

 private:
  std::uint32_t state_;
};

}  // namespace grove::objects::herd
