#include "node/backend/prepare/share_of_scene.h"

namespace grove::node {
namespace {

bool showsVisitors(const LoadedScene& scene, const std::string& type) {
  return scene.visitor && scene.layout.types[scene.layout.visitor->object.type] == type;
}

}  // namespace

std::optional<ServedObjects> namedObjects(const LoadedScene& scene, std::span<const std::string> names,
                                          std::string& unknown) {
  ServedObjects named;
  for (const std::string& name : names) {
    bool isKnown = showsVisitors(scene, name);
    named.visitors = named.visitors || isKnown;
    for (const world::ModelledObject& object : scene.objects) {
      if (object.name != name && scene.layout.types[object.type] != name) continue;
      named.objects.insert(object.id);
      isKnown = true;
    }
    if (isKnown) continue;
    unknown = name;
    return std::nullopt;
  }
  return named;
}

LoadedScene shareOf(const LoadedScene& scene, const ServedObjects& own) {
  LoadedScene share = scene;
  std::erase_if(share.objects, [&](const world::ModelledObject& object) { return !own.contains(object.id); });
  if (!own.visitors) share.visitor.reset();
  return share;
}

}  // namespace grove::node
