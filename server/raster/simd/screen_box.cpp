#include "raster/simd/screen_box.h"

#include <algorithm>

#include "raster/simd/projection_kernels.h"

namespace grove::raster {
namespace {

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
  const auto [left, right, top, bottom, nearest] =
      extentOf({points.x.data(), points.y.data(), points.z.data(), points.x.size()}, Projection(camera, toWorld));
  if (nearest < camera.nearDepth) return most;
  // Approximate division may be off by a hair.
  constexpr float kSlack = 0.01F;
  return {clampedPixel(left - kSlack, most.left, most.right), clampedPixel(top - kSlack, most.top, most.bottom),
          clampedPixel(right + kSlack + 1.0F, most.left, most.right),
          clampedPixel(bottom + kSlack + 1.0F, most.top, most.bottom)};
}

}  // namespace grove::raster
