#include "node/frontend/remote_world.h"

#include <algorithm>
#include <cassert>
#include <string>
#include <utility>

#include "base/error.h"
#include "node/messages/served_objects.h"

namespace grove::node {
namespace {

[[noreturn]] void failAt(const std::string& object) {
  throw EnvironmentError("a node serves " + object + ", which this server's scene does not have", "--nodes",
                         "start it with the scene and the version of this server");
}

/// Adds the facts that only a node's models provide.
void describe(world::Layout& layout, const NodeWelcome& welcome) {
  for (const ServedObject& served : welcome.objects) {
    const auto object = std::ranges::find(layout.objects, served.id, &world::Object::id);
    if (object == layout.objects.end() || object->type != served.type) {
      failAt("object " + std::to_string(served.id) + " " + served.name);
    }
    object->bounds = served.bounds;
    object->obstacleRadius = served.obstacleRadius;
  }
  if (!welcome.visitors) return;
  if (!layout.visitor) failAt("objects of visitors");
  layout.visitor->bounds = welcome.visitors->bounds;
  layout.visitor->hasOwnBody = welcome.visitors->hasOwnBody;
  layout.visitor->castsShadow = welcome.visitors->castsShadow;
}

world::Layout described(world::Layout layout, const std::vector<NodeWelcome>& welcomes) {
  for (const NodeWelcome& welcome : welcomes) describe(layout, welcome);
  return layout;
}

}  // namespace

RemoteWorld::RemoteWorld(world::Layout layout, std::unique_ptr<NodeRouter> nodes)
    : nodes_(std::move(nodes)), layout_(described(std::move(layout), nodes_->welcomes())) {
  assert(restOf(layout_, nodes_->served()).empty());
}

}  // namespace grove::node
