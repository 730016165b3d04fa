#include "world/world_geometry.h"

namespace grove::world {
namespace {

Triangles gather(const std::vector<Object>& objects, const Triangles* (Model::*part)() const) {
  Triangles all;
  for (const Object& object : objects) {
    if (const Triangles* triangles = (*object.model.*part)()) all.append(*triangles, object.transform.matrix());
  }
  return all;
}

}  // namespace

WorldGeometry::WorldGeometry(const std::vector<Object>& objects, const std::function<void(float)>& progress)
    : solids_(gather(objects, &Model::solid), progress),
      shades_(gather(objects, &Model::shade)),
      rays_(shades_, progress) {}

}  // namespace grove::world
