#include "world/scenes/scene_layout.h"

#include <algorithm>
#include <string>

namespace grove::world {
namespace {

void requireKnown(const ObjectDescription& description, std::span<const std::string_view> knownTypes) {
  if (std::ranges::find(knownTypes, description.type) != knownTypes.end()) return;
  std::string known;
  for (const std::string_view name : knownTypes) {
    if (!known.empty()) known += ", ";
    known += name;
  }
  description.parameters.fail("type", "unknown object type '" + description.type + "' (known: " + known + ")");
}

TypeIndex indexOf(const std::string& type, std::vector<std::string>& names) {
  const auto found = std::ranges::find(names, type);
  const auto index = static_cast<TypeIndex>(found - names.begin());
  if (found == names.end()) names.push_back(type);
  return index;
}

}  // namespace

Layout layoutOf(const Scene& scene, std::span<const std::string_view> knownTypes) {
  Layout layout;
  layout.name = scene.name;
  layout.hash = scene.hash;
  layout.spawn = scene.spawn;
  layout.spawnYaw = scene.spawnYaw;
  layout.radius = scene.radius;
  layout.sky = scene.sky;
  layout.hills = scene.hills;
  layout.lights.reserve(scene.lights.size());
  for (const LightDescription& light : scene.lights) {
    layout.lights.push_back({{light.position, light.colour}, light.flicker});
  }
  const auto objectOf = [&](const ObjectDescription& description, ObjectId id) {
    requireKnown(description, knownTypes);
    return Object{.id = id,
                  .type = indexOf(description.type, layout.types),
                  .name = description.name,
                  .transform = description.transform,
                  .bounds = {}};
  };
  layout.objects.reserve(scene.objects.size());
  for (const ObjectDescription& description : scene.objects) {
    layout.objects.push_back(objectOf(description, layout.objects.size() + 1));
  }
  if (scene.visitor) layout.visitor = {.object = objectOf(*scene.visitor, 0), .bounds = {}};
  return layout;
}

}  // namespace grove::world
