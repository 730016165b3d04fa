#pragma once

#include <cmath>

#include "world/geometry.h"

namespace grove::objects::herd {

inline constexpr float kTurn = 6.2831853F;  ///< radians

/// A place on the level and a direction, or the move from one to another. Yaw as in world::Pose: 0 faces -Z.
struct RootMove {
  world::Vec2 place{0.0F};  ///< x and z, metres
  float yaw = 0.0F;         ///< radians

  /// A direction or difference in the root's own coordinates, turned to those of the world.
  [[nodiscard]] world::Vec2 turned(world::Vec2 own) const noexcept {
    const float c = std::cos(yaw);
    const float s = std::sin(yaw);
    return {c * own.x + s * own.y, -s * own.x + c * own.y};
  }
  /// The inverse of turned().
  [[nodiscard]] world::Vec2 own(world::Vec2 turned) const noexcept {
    const float c = std::cos(yaw);
    const float s = std::sin(yaw);
    return {c * turned.x - s * turned.y, s * turned.x + c * turned.y};
  }
  /// This place after a move in its own coordinates.
  [[nodiscard]] RootMove then(const RootMove& move) const noexcept {
    return {place + turned(move.place), yaw + move.yaw};
  }
  /// The move from here to there, in its own coordinates.
  [[nodiscard]] RootMove to(const RootMove& there) const noexcept {
    return {own(there.place - place), there.yaw - yaw};
  }
  [[nodiscard]] world::Vec2 heading() const noexcept { return {-std::sin(yaw), -std::cos(yaw)}; }
};

}  // namespace grove::objects::herd
