#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "world/ground/hills.h"
#include "world/light.h"
#include "world/object.h"
#include "world/players.h"
#include "world/sky.h"

namespace grove::world {

/// A fire or a lamp at a fixed place.
struct FlickeringLight {
  PointLight light;
  float flicker = 0.0F;  ///< 0 steady to 1 wild
};

/// The object that shows a visitor to the others, at the origin.
struct VisitorTemplate {
  Object object;
  Bounds bounds;             ///< in its own coordinates, without its shadow
  bool hasOwnBody = false;   ///< see Model::hasOwnBody()
  bool castsShadow = false;  ///< see Model::castsShadow()
};

/// The layout of a world, known to every node. Constant during the world's life.
struct Layout {
  std::string name;
  std::uint64_t hash = 0;          ///< of the scene file's text
  std::vector<std::string> types;  ///< names of the types of its objects, indexed by TypeIndex
  std::vector<Object> objects;
  std::optional<VisitorTemplate> visitor;  ///< none: visitors are invisible
  std::vector<FlickeringLight> lights;
  Sky sky;
  std::vector<Hill> hills;  ///< of the ground
  Vec3 spawn{0.0F};
  float spawnYaw = 0.0F;
  float radius = 30.0F;

  /// Obstacles that visitors walk around.
  [[nodiscard]] std::vector<Obstacle> obstacles() const;

  /// The object that shows a visitor to the others. Its bounds include its shadow.
  [[nodiscard]] std::optional<Object> objectOf(const Player& player) const;

  /// The part of that object which is only shadow; nothing if it has none.
  [[nodiscard]] std::optional<Object> shadowOf(const Player& player) const;

  /// The world's fixed lights, and the lantern of each of these players; `now` is the world clock.
  [[nodiscard]] std::vector<PointLight> lightsAt(double now, const std::vector<Player>& players) const;
};

}  // namespace grove::world
