#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "world/edits.h"
#include "world/light.h"
#include "world/object.h"
#include "world/players.h"
#include "world/world_geometry.h"

namespace grove::world {

/// Everything that all visitors share, across-user by definition: the objects, the light's obstacles, who is here, and
/// what they do to it. The objects never change after construction; players and edits are safe from any thread.
class World {
 public:
  /// A fire or a lamp that stands somewhere.
  struct FlickeringLight {
    PointLight light;
    float flicker = 0.0F;  ///< 0 steady to 1 wild
  };
  struct Layout {
    std::string name;
    std::vector<Object> objects;
    std::optional<Object> visitor;  ///< template of the object that shows a visitor; none: visitors are invisible
    std::vector<FlickeringLight> lights;
    Vec3 spawn{0.0F};
    float spawnYaw = 0.0F;
    float radius = 30.0F;
  };
  /// Where several copies of a world share its geometry and the roster: those. Null: of its own.
  explicit World(Layout layout, std::shared_ptr<const WorldGeometry> geometry = nullptr,
                 std::shared_ptr<Players> players = nullptr);

  /// An empty roster for worlds of this layout.
  [[nodiscard]] static std::shared_ptr<Players> makePlayers(const Layout& layout);

  [[nodiscard]] const std::string& name() const noexcept { return layout_.name; }
  [[nodiscard]] const std::vector<Object>& objects() const noexcept { return layout_.objects; }
  [[nodiscard]] const std::optional<Object>& visitor() const noexcept { return layout_.visitor; }
  [[nodiscard]] float radius() const noexcept { return layout_.radius; }

  [[nodiscard]] const WorldGeometry& geometry() const noexcept { return *geometry_; }

  [[nodiscard]] Players& players() noexcept { return *players_; }
  [[nodiscard]] Edits& edits() noexcept { return edits_; }

  /// The object that shows a visitor to the others.
  [[nodiscard]] std::optional<Object> objectOf(const Player& player) const;

  /// The lights that stand in the world, and the lantern of each of these players.
  [[nodiscard]] std::vector<PointLight> lights(double now, const std::vector<Player>& players) const;

  /// Seconds of the world's clock.
  [[nodiscard]] static double now() noexcept;

 private:
  const Layout layout_;
  const std::shared_ptr<const WorldGeometry> geometry_;
  const std::shared_ptr<Players> players_;
  Edits edits_;
};

}  // namespace grove::world
