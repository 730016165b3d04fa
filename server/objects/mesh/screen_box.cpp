#include "objects/mesh/screen_box.h"

#include <algorithm>

namespace grove::objects::mesh {
namespace {

using world::Vec3;
using world::Vec4;

/// Pixels from a value that may lie far outside of the image.
int clampedPixel(float value, int low, int high) {
  return static_cast<int>(std::clamp(value, static_cast<float>(low), static_cast<float>(high)));
}

}  // namespace

PointCloud::PointCloud(const Surface& surface) {
  for (const Vertex& vertex : surface.vertices) {
    x.push_back(vertex.position.x);
    y.push_back(vertex.position.y);
    z.push_back(vertex.position.z);
  }
}

world::Rect screenBox(const PointCloud& points, const world::Mat4& toWorld, const world::Camera& camera,
                      const world::Rect& most) {
  const Vec3 forward = camera.pose.forward();
  const float focal = camera.focal();
  const world::Mat4 toObject = glm::transpose(toWorld);
  const auto plane = [&](Vec3 axis) { return toObject * Vec4(axis, -glm::dot(axis, camera.pose.position)); };
  const Vec4 px = plane(camera.pose.right() * focal + forward * (0.5F * static_cast<float>(camera.width)));
  const Vec4 py = plane(camera.pose.up() * -focal + forward * (0.5F * static_cast<float>(camera.height)));
  const Vec4 pz = plane(forward);
  float left = 1.0e9F;
  float right = -1.0e9F;
  float top = 1.0e9F;
  float bottom = -1.0e9F;
  float nearest = 1.0e9F;
  const std::size_t count = points.x.size();
  const float* x = points.x.data();
  const float* y = points.y.data();
  const float* z = points.z.data();
  for (std::size_t i = 0; i < count; ++i) {
    const float depth = pz.x * x[i] + pz.y * y[i] + pz.z * z[i] + pz.w;
    const float u = (px.x * x[i] + px.y * y[i] + px.z * z[i] + px.w) / depth;
    const float v = (py.x * x[i] + py.y * y[i] + py.z * z[i] + py.w) / depth;
    nearest = std::min(nearest, depth);
    left = std::min(left, u);
    right = std::max(right, u);
    top = std::min(top, v);
    bottom = std::max(bottom, v);
  }
  if (nearest < camera.nearDepth) return most;
  // Approximate division may be off by a hair.
  constexpr float kSlack = 0.01F;
  return {clampedPixel(left - kSlack, most.left, most.right), clampedPixel(top - kSlack, most.top, most.bottom),
          clampedPixel(right + kSlack + 1.0F, most.left, most.right),
          clampedPixel(bottom + kSlack + 1.0F, most.top, most.bottom)};
}

}  // namespace grove::objects::mesh
