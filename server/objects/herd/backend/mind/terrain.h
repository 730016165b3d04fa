#pragma once

#include <optional>
#include <span>
#include <vector>

#include "objects/herd/backend/mind/dice.h"
#include "world/ground/hills.h"
#include "world/players.h"

namespace grove::objects::herd {

/// Where a herd lives: the ground, and what stands on it.
class Terrain {
 public:
  /// The herd stays within `range` metres of `home`. `fires` are obstacles that animals keep away from.
  Terrain(world::Vec2 home, float range, std::vector<world::Hill> hills, std::vector<world::Obstacle> obstacles,
          const std::vector<world::Vec2>& fires);

  [[nodiscard]] float height(world::Vec2 place) const noexcept { return world::groundHeight(hills_, place); }
  [[nodiscard]] world::Vec2 home() const noexcept { return home_; }
  [[nodiscard]] float range() const noexcept { return range_; }

  /// Obstacles that may matter within `reach` metres of a place; fires with the distance that animals keep.
  [[nodiscard]] std::vector<world::Obstacle> near(world::Vec2 place, float reach) const;

  /// Distance to the nearest obstacle's or fire's edge, or to the end of the range if that is nearer; negative inside
  /// and outside the range. Metres.
  [[nodiscard]] float room(world::Vec2 place) const noexcept;

  /// The nearest place within the range.
  [[nodiscard]] world::Vec2 inRange(world::Vec2 place) const noexcept;

  /// A place within `radius` metres of `middle` with at least `room` metres around it; nothing after some attempts.
  [[nodiscard]] std::optional<world::Vec2> freePlace(world::Vec2 middle, float radius, float room, Dice& dice) const;

 private:
  const world::Vec2 home_;
  const float range_;
  const std::vector<world::Hill> hills_;
  std::vector<world::Obstacle> obstacles_;  ///< the fires, too
};

}  // namespace grove::objects::herd
