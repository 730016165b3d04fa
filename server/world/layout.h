#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "world/light.h"
#include "world/object.h"
#include "world/players.h"
#include "world/sky.h"

namespace grove::world {

/// A fire or a lamp that stands somewhere.
struct FlickeringLight {
  PointLight light;
  float flicker = 0.0F;  ///< 0 steady to 1 wild
};

/// Object that shows a visitor to the others, at the origin.
struct VisitorTemplate {
  Object object;
  Bounds bounds;            ///< in its own coordinates
  bool hasOwnBody = false;  ///< see Model::hasOwnBody()
};

/// What is where in a world, as every node knows it. Does not change while the world lives.
struct Layout {
  std::string name;
  std::uint64_t hash = 0;          ///< of the scene file's text
  std::vector<std::string> types;  ///< names of the types of its objects; a TypeIndex is a place in this list
  std::vector<Object> objects;
  std::optional<VisitorTemplate> visitor;  ///< none: visitors are invisible
  std::vector<FlickeringLight> lights;
  Sky sky;
  Vec3 spawn{0.0F};
  float spawnYaw = 0.0F;
  float radius = 30.0F;

  /// What visitors walk around.
  [[nodiscard]] std::vector<Obstacle> obstacles() const;

  /// The object that shows a visitor to the others.
  [[nodiscard]] std::optional<Object> objectOf(const Player& player) const;

  /// The lights that stand in the world, and the lantern of each of these players; `now` is of the world's clock.
  [[nodiscard]] std::vector<PointLight> lightsAt(double now, const std::vector<Player>& players) const;
};

}  // namespace grove::world
