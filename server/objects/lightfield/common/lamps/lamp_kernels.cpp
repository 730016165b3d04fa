#include "objects/lightfield/common/lamps/lamp_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "objects/lightfield/common/lamps/lamp_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "objects/lightfield/common/change_pixels_inl.h"

HWY_BEFORE_NAMESPACE();
namespace grove::objects::lightfield::HWY_NAMESPACE {

constexpr float kLampSize = 0.6F;  // square metres; limits the brightness close to a lamp

void lightPart(std::span<const world::PointLight> lamps, const ObjectCamera& camera, const PicturePart& part) {
  changePart(camera, part, [&](Ints pixels, Floats x, Floats y, Floats z) {
    Floats red;
    Floats green;
    Floats blue;
    for (const world::PointLight& lamp : lamps) {
      const Floats dx = lamp.position.x - x;
      const Floats dy = lamp.position.y - y;
      const Floats dz = lamp.position.z - z;
      const Floats squared = mulAdd(dx, dx, mulAdd(dy, dy, dz * dz));
      const Floats fade = max(mulAdd(squared, -1.0F / (kLampReach * kLampReach), 1.0F), 0.0F);
      const Floats share = fade * fade / (squared + kLampSize);
      red = mulAdd(share, lamp.colour.r, red);
      green = mulAdd(share, lamp.colour.g, green);
      blue = mulAdd(share, lamp.colour.b, blue);
    }
    const Floats coverage = channel<24>(pixels);
    const auto lit = [&](Floats value, Floats gain) {
      return truncate(min(mulAdd(value, gain, value), coverage) + 0.5F);
    };
    return lit(channel<0>(pixels), red) | shiftLeft<8>(lit(channel<8>(pixels), green)) |
           shiftLeft<16>(lit(channel<16>(pixels), blue)) | (pixels & kCoverage);
  });
}

DepthRange depthRange(const PicturePart& part) {
  Floats near = kRelightFarthest;
  Floats far;
  DepthRange range;
  for (int row = 0; row < part.rect.height(); ++row) {
    const std::uint32_t* const colour = part.colour + row * part.stride;
    const float* const depth = part.depth + row * part.stride;
    int x = 0;
    for (; x + kLanes <= part.rect.width(); x += kLanes) {
      const Mask shown = load(colour + x) != 0;
      const Floats away = load(depth + x);
      near = min(near, select(shown, away, kRelightFarthest));
      far = max(far, onlyWhere(shown, away));
    }
    for (; x < part.rect.width(); ++x) {
      if (colour[x] == 0) continue;
      range.nearest = depth[x] < range.nearest ? depth[x] : range.nearest;
      range.farthest = depth[x] > range.farthest ? depth[x] : range.farthest;
    }
  }
  const float nearest = minOf(near);
  const float farthest = maxOf(far);
  return {nearest < range.nearest ? nearest : range.nearest, farthest > range.farthest ? farthest : range.farthest};
}

}  // namespace grove::objects::lightfield::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace grove::objects::lightfield {

HWY_EXPORT(lightPart);
HWY_EXPORT(depthRange);

void lightPart(std::span<const world::PointLight> lamps, const ObjectCamera& camera, const PicturePart& part) {
  HWY_DYNAMIC_DISPATCH(lightPart)(lamps, camera, part);
}

DepthRange depthRange(const PicturePart& part) { return HWY_DYNAMIC_DISPATCH(depthRange)(part); }

}  // namespace grove::objects::lightfield

#endif  // HWY_ONCE
