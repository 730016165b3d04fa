#include "objects/lightfield/relight_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "objects/lightfield/relight_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <array>

#include "base/simd/look_up_inl.h"

HWY_BEFORE_NAMESPACE();
namespace grove::objects::lightfield::HWY_NAMESPACE {

using namespace grove::simd::HWY_NAMESPACE;
using world::Vec3;

constexpr float kLampSize = 0.6F;  // keeps what touches a lamp from burning out, square metres

constexpr auto kCoverage = static_cast<std::int32_t>(0xFF000000U);

/// What is left of the display-encoded colour where the sun does not shine: the sky's blue light.
constexpr float kShade[3] = {0.50F, 0.62F, 0.78F};

/// Calls change(colour, depth, pixels from the row's first) and stores what it returns, for as many neighbouring
/// pixels at a time as there are lanes; beyond the ends of rows there are pixels that show nothing.
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

/// The same with all rows and points: change(colour, x, y, z) in object coordinates.
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

/// a at 0, b at 1.
HWY_INLINE Floats between(Floats a, Floats b, Floats at) { return mulAdd(at, b - a, a); }

/// Where in a grid's samples a point is along one axis.
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

HWY_EXPORT(shadePart);
HWY_EXPORT(lightPart);
HWY_EXPORT(depthRange);

void shadePart(const SunGrid& sun, const ObjectCamera& camera, const PicturePart& part) {
  HWY_DYNAMIC_DISPATCH(shadePart)(sun, camera, part);
}

void lightPart(std::span<const world::PointLight> lamps, const ObjectCamera& camera, const PicturePart& part) {
  HWY_DYNAMIC_DISPATCH(lightPart)(lamps, camera, part);
}

DepthRange depthRange(const PicturePart& part) { return HWY_DYNAMIC_DISPATCH(depthRange)(part); }

}  // namespace grove::objects::lightfield

#endif  // HWY_ONCE
