#include "world/world_geometry.h"

namespace grove::world {
namespace {

Triangles gather(const std::vector<ModelledObject>& objects, const Triangles* (Model::*part)() const) {
  Triangles all;
  for (const ModelledObject& object : objects) {
    if (const Triangles* triangles = (*object.model.*part)()) all.append(*triangles, object.transform.matrix());
  }
  return all;
}

}  // namespace

WorldGeometry::WorldGeometry(const std::vector<ModelledObject>& objects, const std::function<void(float)>& progress)
    : solids_(gather(objects, &Model::solid), progress),
      shades_(gather(objects, &Model::shade)),
      rays_(shades_, progress) {}

}  // namespace grove::world
