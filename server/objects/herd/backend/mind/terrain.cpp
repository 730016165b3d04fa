#include "objects/herd/backend/mind/terrain.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "objects/herd/backend/motion/root_move.h"

namespace grove::objects::herd {
namespace {

using world::Obstacle;
using world::Vec2;

constexpr float kFireDistance = 4.5F;  ///< metres
constexpr int kAttempts = 40;

}  // namespace

Terrain::Terrain(Vec2 home, float range, std::vector<world::Hill> hills, std::vector<Obstacle> obstacles,
                 const std::vector<Vec2>& fires)
    : home_(home), range_(range), hills_(std::move(hills)), obstacles_(std::move(obstacles)) {
  for (const Vec2& fire : fires) obstacles_.push_back({fire, kFireDistance});
}

std::vector<Obstacle> Terrain::near(Vec2 place, float reach) const {
  std::vector<Obstacle> close;
  std::ranges::copy_if(obstacles_, std::back_inserter(close),
                       [&](const Obstacle& one) { return glm::distance(one.centre, place) < reach + one.radius; });
  return close;
}

float Terrain::room(Vec2 place) const noexcept {
  float room = range_ - glm::distance(place, home_);
  for (const Obstacle& one : obstacles_) room = std::min(room, glm::distance(place, one.centre) - one.radius);
  return room;
}

Vec2 Terrain::inRange(Vec2 place) const noexcept {
  const float distance = glm::distance(place, home_);
  return distance <= range_ ? place : home_ + (place - home_) * (range_ / distance);
}

std::optional<Vec2> Terrain::freePlace(Vec2 middle, float radius, float room, Dice& dice) const {
  for (int i = 0; i < kAttempts; ++i) {
    const float angle = dice.between(0.0F, kTurn);
    const float distance = radius * std::sqrt(dice.share());
    const Vec2 place = middle + distance * Vec2(std::cos(angle), std::sin(angle));
    if (this->room(place) >= room) return place;
  }
  return std::nullopt;
}

}  // namespace grove::objects::herd
