#pragma once

#include <cmath>

#include "node/messages/packing/packing.h"
#include "objects/lightfield/format/view_camera.h"

/// Cameras and positions in packed data.
namespace grove::objects::lightfield {

inline void putVec3(node::PackWriter& writer, world::Vec3 value) { writer.put(value.x).put(value.y).put(value.z); }

/// Throws node::PackingError unless it is finite.
[[nodiscard]] inline world::Vec3 takeVec3(node::PackReader& reader) {
  constexpr float kMax = 1.0e6F;
  world::Vec3 value(0.0F);
  for (int axis = 0; axis < 3; ++axis) value[axis] = reader.takeFinite(-kMax, kMax);
  return value;
}

inline void putCamera(node::PackWriter& writer, const ObjectCamera& camera) {
  for (const world::Vec3& value : {camera.eye, camera.corner, camera.perColumn, camera.perRow}) putVec3(writer, value);
}

[[nodiscard]] inline ObjectCamera takeCamera(node::PackReader& reader) {
  ObjectCamera camera;
  for (world::Vec3* const value : {&camera.eye, &camera.corner, &camera.perColumn, &camera.perRow}) {
    *value = takeVec3(reader);
  }
  return camera;
}

}  // namespace grove::objects::lightfield
