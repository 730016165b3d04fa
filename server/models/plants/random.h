#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

#include "world/geometry.h"
#include "world/noise.h"

namespace grove::models {

inline constexpr float kTurn = 2.0F * std::numbers::pi_v<float>;

/// Random numbers that are the same with every standard library: a hashed counter.
class Random {
 public:
  explicit Random(std::uint32_t seed) : state_(world::hash(seed ^ 0x9E3779B9U)) {}

  /// From 0 up to, not including, 1.
  float unit() { return static_cast<float>(next() >> 8U) * (1.0F / 16777216.0F); }
  float range(float low, float high) { return low + (high - low) * unit(); }
  /// Between -1 and 1, more often near 0.
  float around() { return unit() + unit() + unit() - 1.5F; }
  bool chance(float share) { return unit() < share; }
  float angle() { return kTurn * unit(); }

  /// A unit vector.
  world::Vec3 direction() {
    const float y = range(-1.0F, 1.0F);
    const float turn = angle();
    const float radius = std::sqrt(1.0F - y * y);
    return {radius * std::cos(turn), y, radius * std::sin(turn)};
  }

  /// A point in the unit ball.
  world::Vec3 inBall() { return direction() * std::cbrt(unit()); }

  /// An independent sequence with a new seed: draws of one part do not affect the others.
  Random fork() { return Random(next()); }

 private:
  std::uint32_t next() {
    state_ += 0x9E3779B9U;
    return world::hash(state_);
  }

  std::uint32_t state_;
};

}  // namespace grove::models
