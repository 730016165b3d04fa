#include "objects/lightfield/backend/surroundings/shadow_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "objects/lightfield/backend/surroundings/shadow_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "base/simd/look_up_inl.h"
#include "objects/lightfield/common/change_pixels_inl.h"

HWY_BEFORE_NAMESPACE();
namespace grove::objects::lightfield::HWY_NAMESPACE {

/// Factor of the display-encoded colour in shade: the sky's blue light remains.
constexpr float kShade[3] = {0.50F, 0.62F, 0.78F};

/// Linear interpolation: a at 0, b at 1.
HWY_INLINE Floats between(Floats a, Floats b, Floats at) { return mulAdd(at, b - a, a); }

/// Position of a point among a grid's samples along one axis.
struct GridPlace {
  Ints sample;
  Floats beyond;

  HWY_INLINE GridPlace(Floats point, float low, float perMetre, int cells) {
    const Floats place = clamp((point - low) * perMetre, 0.0F, static_cast<float>(cells - 1) - 0.001F);
    sample = truncate(place);
    beyond = place - toFloats(sample);
  }
};

/// The trilinear share of the sun.
HWY_INLINE Floats sunAt(const SunGrid& grid, const float* sun, Floats x, Floats y, Floats z) {
  const int nx = grid.cells[0];
  const int ny = grid.cells[1];
  const GridPlace u(x, grid.low.x, grid.perMetre.x, nx);
  const GridPlace v(y, grid.low.y, grid.perMetre.y, ny);
  const GridPlace w(z, grid.low.z, grid.perMetre.z, grid.cells[2]);
  const Ints at = (w.sample * ny + v.sample) * nx + u.sample;
  const auto along = [&](int from) {
    const FloatPair samples = lookUpPair(sun + from, at);
    return between(samples.first, samples.second, u.beyond);
  };
  const auto plane = [&](int from) { return between(along(from), along(from + nx), v.beyond); };
  return between(plane(0), plane(nx * ny), w.beyond);
}

void shadePart(const SunGrid& sun, const ObjectCamera& camera, const PicturePart& part) {
  const float* const samples = sun.sun.data();
  changePart(camera, part, [&](Ints pixels, Floats x, Floats y, Floats z) {
    const Floats share = sunAt(sun, samples, x, y, z);
    const auto scaled = [&](Floats value, float shade) {
      return truncate(mulAdd(value, mulAdd(share, 1.0F - shade, shade), 0.5F));
    };
    return scaled(channel<0>(pixels), kShade[0]) | shiftLeft<8>(scaled(channel<8>(pixels), kShade[1])) |
           shiftLeft<16>(scaled(channel<16>(pixels), kShade[2])) | (pixels & kCoverage);
  });
}

}  // namespace grove::objects::lightfield::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace grove::objects::lightfield {

HWY_EXPORT(shadePart);

void shadePart(const SunGrid& sun, const ObjectCamera& camera, const PicturePart& part) {
  HWY_DYNAMIC_DISPATCH(shadePart)(sun, camera, part);
}

}  // namespace grove::objects::lightfield

#endif  // HWY_ONCE
