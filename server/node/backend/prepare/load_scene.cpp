#include "node/backend/prepare/load_scene.h"

#include <utility>

#include "world/scenes/scene_layout.h"

namespace grove::node {
namespace {

std::shared_ptr<const world::Model> modelOf(const world::ObjectDescription& description, const BackendTypes& types) {
  auto model = types.find(description.type)->model(description.parameters);
  description.parameters.finish();
  return model;
}

}  // namespace

LoadedScene loadScene(const world::Scene& scene, const BackendTypes& types) {
  return loadScene(scene, types, restOf(world::layoutOf(scene, types.names()), {}));
}

LoadedScene loadScene(const world::Scene& scene, const BackendTypes& types, const ServedObjects& own) {
  LoadedScene loaded;
  loaded.layout = world::layoutOf(scene, types.names());
  loaded.objects.reserve(own.objects.size());
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    world::Object& object = loaded.layout.objects[i];
    if (!own.contains(object.id)) continue;
    auto model = modelOf(scene.objects[i], types);
    object.bounds = object.transform.apply(model->bounds());
    if (model->hasHills() && !scene.hills.empty()) object.bounds.high.y += world::kMaxGroundHeight;
    object.obstacleRadius = model->obstacleRadius().value_or(0.0F) * object.transform.scale;
    loaded.objects.push_back({object, std::move(model)});
  }
  if (own.visitors) {
    loaded.visitor = modelOf(*scene.visitor, types);
    loaded.layout.visitor->bounds = loaded.visitor->bounds();
    loaded.layout.visitor->hasOwnBody = loaded.visitor->hasOwnBody();
    loaded.layout.visitor->castsShadow = loaded.visitor->castsShadow();
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
