#include "world/world.h"

#include <utility>

#include "pipeline/clocks.h"

namespace grove::world {

World::World(Layout layout, std::shared_ptr<Players> players)
    : layout_(std::move(layout)), players_(players ? std::move(players) : makePlayers(layout_)) {}

std::shared_ptr<Players> World::makePlayers(const Layout& layout) {
  return std::make_shared<Players>(layout.spawn, layout.spawnYaw, layout.radius, layout.obstacles);
}

double World::now() noexcept { return static_cast<double>(pipeline::wallNanoseconds()) * 1e-9; }

}  // namespace grove::world
