// Changes the pixels of a picture depending on their points in space. For kernels: included once per target.

#if defined(GROVE_OBJECTS_LIGHTFIELD_COMMON_CHANGE_PIXELS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef GROVE_OBJECTS_LIGHTFIELD_COMMON_CHANGE_PIXELS_INL_H
#undef GROVE_OBJECTS_LIGHTFIELD_COMMON_CHANGE_PIXELS_INL_H
#else
#define GROVE_OBJECTS_LIGHTFIELD_COMMON_CHANGE_PIXELS_INL_H
#endif

#include <hwy/highway.h>

#include <cstdint>

#include "base/simd/lanes_inl.h"
#include "objects/lightfield/common/picture_part.h"
#include "objects/lightfield/format/view_camera.h"

HWY_BEFORE_NAMESPACE();
namespace grove::objects::lightfield::HWY_NAMESPACE {

using namespace grove::simd::HWY_NAMESPACE;
using world::Vec3;

constexpr auto kCoverage = static_cast<std::int32_t>(0xFF000000U);

/// Calls change(colour, depth, index of the first pixel in its row) for a vector of adjacent pixels at a time and
/// stores the result. Beyond the ends of rows it passes empty pixels.
template <typename Change>
HWY_INLINE void changeRow(std::uint32_t* colour, const float* depth, int width, const Change& change) {
  int x = 0;
  for (; x + kLanes <= width; x += kLanes) {
    const Ints pixels = load(colour + x);
    if (!any(pixels != 0)) continue;
    store(change(pixels, load(depth + x), x), colour + x);
  }
  if (x == width) return;
  std::uint32_t someColour[kLanes] = {};
  float someDepth[kLanes] = {};
  for (int i = x; i < width; ++i) {
    someColour[i - x] = colour[i];
    someDepth[i - x] = depth[i];
  }
  store(change(load(someColour), load(someDepth), x), someColour);
  for (int i = x; i < width; ++i) colour[i] = someColour[i - x];
}

/// The same for all rows, with points: change(colour, x, y, z) in object coordinates.
template <typename Change>
HWY_INLINE void changePart(const ObjectCamera& camera, const PicturePart& part, const Change& change) {
  for (int row = 0; row < part.rect.height(); ++row) {
    const Vec3 ray =
        camera.ray(static_cast<float>(part.rect.left) + 0.5F, static_cast<float>(part.rect.top + row) + 0.5F);
    const auto changeThere = [&](Ints pixels, Floats depth, int first) {
      const Floats column = toFloats(upwards() + first);
      const Floats t = min(depth, kRelightFarthest);
      return change(pixels, mulAdd(t, mulAdd(column, camera.perColumn.x, ray.x), camera.eye.x),
                    mulAdd(t, mulAdd(column, camera.perColumn.y, ray.y), camera.eye.y),
                    mulAdd(t, mulAdd(column, camera.perColumn.z, ray.z), camera.eye.z));
    };
    changeRow(part.colour + row * part.stride, part.depth + row * part.stride, part.rect.width(), changeThere);
  }
}

template <int kShift>
HWY_INLINE Floats channel(Ints pixels) {
  return toFloats(shiftRight<kShift>(pixels) & 0xFF);
}

}  // namespace grove::objects::lightfield::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // once per target
