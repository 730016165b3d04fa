#include "raster/simd/projection_kernels.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "raster/simd/projection_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace grove::raster::HWY_NAMESPACE {

using world::Vec4;

Extent extentOf(const Points& points, const Projection& projection) {
  const float* __restrict x = points.x;
  const float* __restrict y = points.y;
  const float* __restrict z = points.z;
  const Vec4 pu = projection.u;
  const Vec4 pv = projection.v;
  const Vec4 pz = projection.depth;
  constexpr float kFar = 1.0e9F;
  float left = kFar;
  float right = -kFar;
  float top = kFar;
  float bottom = -kFar;
  float nearest = kFar;
  for (std::size_t i = 0; i < points.count; ++i) {
    const float depth = pz.x * x[i] + pz.y * y[i] + pz.z * z[i] + pz.w;
    const float u = (pu.x * x[i] + pu.y * y[i] + pu.z * z[i] + pu.w) / depth;
    const float v = (pv.x * x[i] + pv.y * y[i] + pv.z * z[i] + pv.w) / depth;
    nearest = std::min(nearest, depth);
    left = std::min(left, u);
    right = std::max(right, u);
    top = std::min(top, v);
    bottom = std::max(bottom, v);
  }
  return {left, right, top, bottom, nearest};
}

float transform(const Points& points, const Projection& projection, float* __restrict u, float* __restrict v,
                float* __restrict depth) {
  const float* __restrict x = points.x;
  const float* __restrict y = points.y;
  const float* __restrict z = points.z;
  const Vec4 pu = projection.u;
  const Vec4 pv = projection.v;
  const Vec4 pz = projection.depth;
  float nearest = world::kInfiniteDepth;
  for (std::size_t i = 0; i < points.count; ++i) {
    u[i] = pu.x * x[i] + pu.y * y[i] + pu.z * z[i] + pu.w;
    v[i] = pv.x * x[i] + pv.y * y[i] + pv.z * z[i] + pv.w;
    depth[i] = pz.x * x[i] + pz.y * y[i] + pz.z * z[i] + pz.w;
    nearest = std::min(nearest, depth[i]);
  }
  return nearest;
}

void makeCorners(const float* __restrict u, const float* __restrict v, const float* __restrict depth,
                 const std::uint32_t* __restrict light, const float* __restrict lichen, std::size_t count,
                 float nearDepth, Corner* __restrict corners) {
  for (std::size_t i = 0; i < count; ++i) {
    const float perDepth = 1.0F / depth[i];
    const float reversed = nearDepth * perDepth;
    const std::uint32_t packed = light[i];
    corners[i] = {onGrid(u[i] * perDepth),
                  onGrid(v[i] * perDepth),
                  {reversed, byteOf(packed, 0) * reversed, byteOf(packed, 8) * reversed, byteOf(packed, 16) * reversed,
                   byteOf(packed, 24) * kReliefOfByte * reversed, lichen[i] * 15.0F * reversed}};
  }
}

}  // namespace grove::raster::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace grove::raster {

HWY_EXPORT(extentOf);
HWY_EXPORT(transform);
HWY_EXPORT(makeCorners);

Extent extentOf(const Points& points, const Projection& projection) {
  return HWY_DYNAMIC_DISPATCH(extentOf)(points, projection);
}

float transform(const Points& points, const Projection& projection, float* u, float* v, float* depth) {
  return HWY_DYNAMIC_DISPATCH(transform)(points, projection, u, v, depth);
}

void makeCorners(const float* u, const float* v, const float* depth, const std::uint32_t* light, const float* lichen,
                 std::size_t count, float nearDepth, Corner* corners) {
  HWY_DYNAMIC_DISPATCH(makeCorners)(u, v, depth, light, lichen, count, nearDepth, corners);
}

}  // namespace grove::raster

#endif  // HWY_ONCE
