#include "node/backend/prepare/share_of_scene.h"

namespace grove::node {
namespace {

bool showsVisitors(const world::Layout& layout, const std::string& type) {
  return layout.visitor && layout.types[layout.visitor->object.type] == type;
}

}  // namespace

std::optional<ServedObjects> namedObjects(const world::Layout& layout, std::span<const std::string> names,
                                          std::string& unknown) {
  ServedObjects named;
  for (const std::string& name : names) {
    bool isKnown = showsVisitors(layout, name);
    named.visitors = named.visitors || isKnown;
    for (const world::Object& object : layout.objects) {
      if (object.name != name && layout.types[object.type] != name) continue;
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

world::Scene shareOf(const world::Scene& scene, const ServedObjects& own) {
  world::Scene share = scene;
  share.objects.clear();
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    if (own.contains(i + 1)) share.objects.push_back(scene.objects[i]);
  }
  if (!own.visitors) share.visitor.reset();
  return share;
}

const BackendType* typeThatNeedsAllModels(const world::Layout& layout, const ServedObjects& own,
                                          const BackendTypes& types) {
  const auto needing = [&](const world::Object& object) -> const BackendType* {
    const BackendType* const type = types.find(layout.types[object.type]);
    return type->needsAllModels() ? type : nullptr;
  };
  for (const world::Object& object : layout.objects) {
    if (!own.contains(object.id)) continue;
    if (const BackendType* const type = needing(object)) return type;
  }
  return own.visitors ? needing(layout.visitor->object) : nullptr;
}

}  // namespace grove::node
