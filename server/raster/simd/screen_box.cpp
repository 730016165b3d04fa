#include "raster/simd/screen_box.h"

#include <algorithm>

#include "raster/simd/projection_kernels.h"

namespace grove::raster {
namespace {

/// Clamps a value that may lie far outside the image.
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
                      const world::Rect& max) {
  const auto [left, right, top, bottom, nearest] =
      extentOf({points.x.data(), points.y.data(), points.z.data(), points.x.size()}, Projection(camera, toWorld));
  if (nearest < camera.nearDepth) return max;
  // Tolerance for approximate division.
  constexpr float kSlack = 0.01F;
  return {clampedPixel(left - kSlack, max.left, max.right), clampedPixel(top - kSlack, max.top, max.bottom),
          clampedPixel(right + kSlack + 1.0F, max.left, max.right),
          clampedPixel(bottom + kSlack + 1.0F, max.top, max.bottom)};
}

}  // namespace grove::raster
