#include "node/registry.h"

#include <cassert>
#include <utility>

namespace grove::node {

void Registry::add(std::unique_ptr<const ObjectType> type) {
  assert(!find(type->name()));
  types_.push_back(std::move(type));
}

std::optional<world::TypeIndex> Registry::find(std::string_view name) const {
  for (std::size_t i = 0; i < types_.size(); ++i) {
    if (types_[i]->name() == name) return static_cast<world::TypeIndex>(i);
  }
  return std::nullopt;
}

std::vector<std::string_view> Registry::names() const {
  std::vector<std::string_view> names;
  for (const auto& type : types_) names.push_back(type->name());
  return names;
}

namespace {

world::Object makeObject(const world::ObjectDescription& description, const Registry& registry) {
  const auto index = registry.find(description.type);
  if (!index) {
    std::string known;
    for (const std::string_view name : registry.names()) known += (known.empty() ? "" : ", ") + std::string(name);
    description.parameters.fail("type", "unknown object type '" + description.type + "' (known: " + known + ")");
  }
  world::Object object;
  object.type = *index;
  object.name = description.name;
  object.transform = description.transform;
  object.model = registry.type(*index).model(description.parameters);
  description.parameters.finish();
  object.bounds = object.transform.apply(object.model->bounds());
  return object;
}

}  // namespace

world::World::Layout makeLayout(const world::Scene& scene, const Registry& registry) {
  world::World::Layout layout;
  layout.name = scene.name;
  layout.spawn = scene.spawn;
  layout.spawnYaw = scene.spawnYaw;
  layout.radius = scene.radius;
  for (const world::LightDescription& light : scene.lights) {
    layout.lights.push_back({{light.position, light.colour}, light.flicker});
  }
  for (const world::ObjectDescription& description : scene.objects) {
    layout.objects.push_back(makeObject(description, registry));
    layout.objects.back().id = static_cast<world::ObjectId>(layout.objects.size());
  }
  if (scene.visitor) layout.visitor = makeObject(*scene.visitor, registry);
  return layout;
}

}  // namespace grove::node
