#include "world/world_geometry.h"

namespace grove::world {
namespace {

std::vector<PlacedTriangles> gather(const std::vector<ModelledObject>& objects,
                                    const Triangles* (Model::*part)() const) {
  std::vector<PlacedTriangles> all;
  for (const ModelledObject& object : objects) {
    const Triangles* const triangles = (*object.model.*part)();
    if (triangles != nullptr) all.push_back({{object.model, triangles}, object.transform.matrix()});
  }
  return all;
}

}  // namespace

WorldGeometry::WorldGeometry(const std::vector<ModelledObject>& objects, const std::function<void(float)>& progress)
    : solids_(gather(objects, &Model::solid), progress),
      shades_(gather(objects, &Model::shade)),
      rays_(shades_, progress) {}

}  // namespace grove::world
