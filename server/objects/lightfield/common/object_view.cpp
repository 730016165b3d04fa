#include "objects/lightfield/common/object_view.h"

#include <algorithm>
#include <cmath>

#include "world/light.h"

namespace grove::objects::lightfield {

using world::Vec3;

namespace {

/// View depth in metres; nearer points may be anywhere in the picture.
constexpr float kMinAhead = 0.05F;

/// Width of a pixel at a distance, both in the object's metres.
float pixelAt(const ObjectCamera& camera, float distance) {
  const Vec3 axis = glm::normalize(glm::cross(camera.perColumn, camera.perRow));
  return distance * glm::length(camera.perRow) / std::abs(glm::dot(camera.corner, axis));
}

/// Width of a texel in the middle of a typical view, in the object's metres.
float texelOf(const ViewGeometry& geometry, int viewSize) {
  const ViewCamera view = viewCamera(geometry, {0.0F, 1.0F, 0.0F});
  return glm::distance(view.eye, geometry.target) / (view.focal * static_cast<float>(viewSize));
}

}  // namespace

ObjectCamera objectCamera(const world::Camera& camera, const world::Transform& transform) {
  const world::Mat4 toObject = glm::inverse(transform.matrix());
  const glm::mat3 turn(toObject);
  ObjectCamera result;
  result.eye = Vec3(toObject * world::Vec4(camera.pose.position, 1.0F));
  const Vec3 corner = camera.ray(0.0F, 0.0F);
  result.corner = turn * corner;
  // Computed over the whole image, because the difference of two pixels' rays has few digits.
  const auto width = static_cast<float>(camera.width);
  const auto height = static_cast<float>(camera.height);
  result.perColumn = turn * ((camera.ray(width, 0.0F) - corner) / width);
  result.perRow = turn * ((camera.ray(0.0F, height) - corner) / height);
  return result;
}

Haze hazeBefore(const world::Bounds& worldBounds, const world::Sky& sky, const world::Camera& camera) {
  const Vec3 towards = worldBounds.centre() - camera.pose.position;
  const float distance = std::max(glm::length(towards), 1.0e-3F);
  const Vec3 colour = sky.hazeColour(towards / distance);
  return {{world::toDisplay(colour.r), world::toDisplay(colour.g), world::toDisplay(colour.b)},
          world::hazeAmount(distance)};
}

ObjectCamera coarser(const ObjectCamera& camera, float times) {
  ObjectCamera result = camera;
  result.perColumn *= times;
  result.perRow *= times;
  return result;
}

int levelFor(const LightField& field, const ObjectCamera& camera) {
  const float distance = std::max(glm::distance(camera.eye, field.geometry.target), 0.25F * field.geometry.extent);
  const float texels = pixelAt(camera, distance) / texelOf(field.geometry, field.size);
  const float level = std::floor(std::log2(std::max(texels, 1.0e-3F)) + 0.35F);
  return std::clamp(static_cast<int>(level), 0, field.levels - 1);
}

world::Rect boxOf(const world::Bounds& bounds, const ObjectCamera& camera, const world::Rect& whole) {
  const glm::mat3 toPixels = glm::inverse(glm::mat3(camera.perColumn, camera.perRow, camera.corner));
  glm::vec2 low(1.0e6F);
  glm::vec2 high(-1.0e6F);
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 point((corner & 1) != 0 ? bounds.high.x : bounds.low.x, (corner & 2) != 0 ? bounds.high.y : bounds.low.y,
                     (corner & 4) != 0 ? bounds.high.z : bounds.low.z);
    const Vec3 at = toPixels * (point - camera.eye);
    if (at.z < kMinAhead) return whole;
    low = glm::min(low, glm::vec2(at) / at.z);
    high = glm::max(high, glm::vec2(at) / at.z);
  }
  const glm::vec2 first(whole.left, whole.top);
  const glm::vec2 end(whole.right, whole.bottom);
  low = glm::clamp(glm::floor(low), first, end);
  high = glm::clamp(glm::ceil(high), first, end);
  return {static_cast<int>(low.x), static_cast<int>(low.y), static_cast<int>(high.x), static_cast<int>(high.y)};
}

float texelWidth(const ViewGeometry& geometry, int viewSize, const ObjectCamera& camera) {
  return texelOf(geometry, viewSize) / pixelAt(camera, glm::distance(camera.eye, geometry.target));
}

float magnification(const ViewGeometry& geometry, int viewSize, const ObjectCamera& camera) {
  const float behind = glm::distance(camera.eye, geometry.target) + 0.5F * geometry.extent;
  return std::max(1.0F, texelOf(geometry, viewSize) / pixelAt(camera, behind));
}

}  // namespace grove::objects::lightfield
