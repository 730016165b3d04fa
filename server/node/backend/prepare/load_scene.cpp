#include "node/backend/prepare/load_scene.h"

#include <algorithm>
#include <string>
#include <utility>

namespace grove::node {
namespace {

const BackendType& typeOf(const world::ObjectDescription& description, const BackendTypes& types) {
  if (const BackendType* type = types.find(description.type)) return *type;
  std::string known;
  for (const std::string_view name : types.names()) {
    if (!known.empty()) known += ", ";
    known += name;
  }
  description.parameters.fail("type", "unknown object type '" + description.type + "' (known: " + known + ")");
}

world::TypeIndex indexOf(const std::string& type, std::vector<std::string>& names) {
  const auto found = std::ranges::find(names, type);
  const auto index = static_cast<world::TypeIndex>(found - names.begin());
  if (found == names.end()) names.push_back(type);
  return index;
}

world::ModelledObject load(const world::ObjectDescription& description, const BackendTypes& types,
                           world::Layout& layout) {
  const BackendType& type = typeOf(description, types);
  world::ModelledObject object;
  object.type = indexOf(description.type, layout.types);
  object.name = description.name;
  object.transform = description.transform;
  object.model = type.model(description.parameters);
  description.parameters.finish();
  object.bounds = object.transform.apply(object.model->bounds());
  return object;
}

std::optional<world::Obstacle> obstacleOf(const world::ModelledObject& object) {
  const auto radius = object.model->obstacleRadius();
  if (!radius) return std::nullopt;
  const world::Vec3 at = object.transform.position;
  return world::Obstacle{{at.x, at.z}, *radius * object.transform.scale};
}

}  // namespace

LoadedScene loadScene(const world::Scene& scene, const BackendTypes& types) {
  LoadedScene loaded;
  world::Layout& layout = loaded.layout;
  layout.name = scene.name;
  layout.hash = scene.hash;
  layout.spawn = scene.spawn;
  layout.spawnYaw = scene.spawnYaw;
  layout.radius = scene.radius;
  layout.sky = scene.sky;
  layout.lights.reserve(scene.lights.size());
  for (const world::LightDescription& light : scene.lights) {
    layout.lights.push_back({{light.position, light.colour}, light.flicker});
  }
  loaded.objects.reserve(scene.objects.size());
  layout.objects.reserve(scene.objects.size());
  for (const world::ObjectDescription& description : scene.objects) {
    world::ModelledObject& object = loaded.objects.emplace_back(load(description, types, layout));
    object.id = static_cast<world::ObjectId>(loaded.objects.size());
    layout.objects.push_back(object);
    if (const auto obstacle = obstacleOf(object)) layout.obstacles.push_back(*obstacle);
  }
  if (scene.visitor) {
    world::ModelledObject visitor = load(*scene.visitor, types, layout);
    layout.visitor = {static_cast<const world::Object&>(visitor), visitor.model->bounds(), visitor.model->hasOwnBody()};
    loaded.visitor = std::move(visitor.model);
  }
  for (const auto& [name, parameters] : scene.typeOptions) {
    const BackendType* const type = types.find(name);
    if (type == nullptr) parameters.fail("", "there is no such type of object");
    if (auto options = type->options(parameters)) loaded.options.emplace(name, std::move(options));
    parameters.finish();
  }
  return loaded;
}

}  // namespace grove::node
