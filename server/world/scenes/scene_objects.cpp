#include "world/scenes/scene_objects.h"

#include <cstddef>
#include <string>

namespace grove::world {
namespace {

constexpr double kMinScale = 0.01;
constexpr double kMaxScale = 100.0;

/// A row of `places`: x, z, yaw in degrees, scale.
Transform placeOf(const Parameters& parameters, float y, const std::vector<double>& row) {
  const auto within = [&](double value, double low, double high) {
    if (!(value >= low && value <= high)) parameters.fail("places", "'places' has a number out of range");
    return static_cast<float>(value);
  };
  Transform transform;
  transform.position = Vec3(within(row[0], -kMaxMetres, kMaxMetres), y, within(row[1], -kMaxMetres, kMaxMetres));
  transform.yaw = glm::radians(within(row[2], -360.0, 360.0));
  transform.scale = within(row[3], kMinScale, kMaxScale);
  return transform;
}

}  // namespace

ObjectDescription readObject(const Parameters& parameters) {
  ObjectDescription object{parameters.text("type", ""), parameters.text("name", ""), {}, parameters};
  if (object.type.empty()) parameters.fail("type", "'type' is missing");
  object.transform.position = parameters.vector("position", Vec3(0.0F));
  object.transform.yaw = glm::radians(static_cast<float>(parameters.number("yaw_degrees", 0.0, -360.0, 360.0)));
  object.transform.scale = static_cast<float>(parameters.number("scale", 1.0, kMinScale, kMaxScale));
  return object;
}

std::vector<ObjectDescription> readObjects(const Parameters& parameters) {
  const auto rows = parameters.rows("places", 4);
  const ObjectDescription object = readObject(parameters);
  if (rows.empty()) return {object};
  std::vector<ObjectDescription> copies(rows.size(), object);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    copies[i].name.append(" ").append(std::to_string(i + 1));
    copies[i].transform = placeOf(parameters, object.transform.position.y, rows[i]);
  }
  return copies;
}

}  // namespace grove::world
