#include "world/world.h"

#include <utility>

namespace grove::world {

World::World(Layout layout, std::shared_ptr<Players> players)
    : layout_(std::move(layout)), players_(players ? std::move(players) : makePlayers(layout_)) {}

std::shared_ptr<Players> World::makePlayers(const Layout& layout, PlayerId base) {
  return std::make_shared<Players>(layout.spawn, layout.spawnYaw, layout.radius, layout.obstacles(), layout.hills,
                                   base);
}

}  // namespace grove::world
