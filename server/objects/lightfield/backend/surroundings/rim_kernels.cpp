#include "objects/lightfield/backend/surroundings/rim_kernels.h"

#include "models/plants/plants.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "objects/lightfield/backend/surroundings/rim_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "objects/lightfield/common/change_pixels_inl.h"

HWY_BEFORE_NAMESPACE();
namespace grove::objects::lightfield::HWY_NAMESPACE {

/// Metres from a tile's edges in which plants end; half of it on average.
constexpr float kRagged = 0.6F;

/// Height of the plants, in metres per metre from where they end.
constexpr float kSlope = 1.2F;

/// Between thin plants, their dark soil would look like holes in the grass of the ground: it begins farther inside.
constexpr float kSoilTop = 0.07F;   // metres above the ground
constexpr float kSoilStart = 0.3F;  // metres from where plants end
constexpr float kSoilFull = 0.6F;

/// Metres of height over which plants become transparent.
constexpr float kFade = 0.08F;

/// Square of a point's distance from an edge.
HWY_INLINE Floats squareFrom(const Rims::Edge& edge, Floats x, Floats z) {
  constexpr float kHalf = 0.5F * models::kTileRadius;
  const Floats fromX = x - edge.middle.x;
  const Floats fromZ = z - edge.middle.y;
  const Floats along = clamp(mulAdd(fromX, edge.along.x, fromZ * edge.along.y), -kHalf, kHalf);
  const Floats restX = fromX - along * edge.along.x;
  const Floats restZ = fromZ - along * edge.along.y;
  return mulAdd(restX, restX, restZ * restZ);
}

/// From 0 to 1, by the mean of triangle waves.
HWY_INLINE Floats raggedness(const Rims& rims, Floats x, Floats z) {
  Floats sum = 0.0F;
  for (const Rims::Wave& wave : rims.waves) {
    const Floats phase = mulAdd(x, wave.vector.x, mulAdd(z, wave.vector.y, wave.offset));
    sum += abs(mulAdd(phase - floor(phase), 2.0F, -1.0F));
  }
  return sum * (1.0F / static_cast<float>(std::tuple_size_v<decltype(rims.waves)>));
}

void thinPart(const Rims& rims, const ObjectCamera& camera, const PicturePart& part) {
  changePart(camera, part, [&](Ints pixels, Floats x, Floats y, Floats z) {
    Floats square = squareFrom(rims.edges.front(), x, z);
    for (const Rims::Edge& edge : rims.edges) square = min(square, squareFrom(edge, x, z));
    const Floats within = mulAdd(raggedness(rims, x, z), -kRagged, sqrt(square));
    const Floats plants = (within * kSlope - y) * (1.0F / kFade);
    const Floats soil = (within - kSoilStart) * (1.0F / (kSoilFull - kSoilStart));
    const Floats share = clamp(select(y < kSoilTop, min(plants, soil), plants), 0.0F, 1.0F);
    const auto scaled = [&](Floats value) { return truncate(mulAdd(value, share, 0.5F)); };
    return scaled(channel<0>(pixels)) | shiftLeft<8>(scaled(channel<8>(pixels))) |
           shiftLeft<16>(scaled(channel<16>(pixels))) | shiftLeft<24>(scaled(channel<24>(pixels)));
  });
}

}  // namespace grove::objects::lightfield::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace grove::objects::lightfield {

HWY_EXPORT(thinPart);

void thinPart(const Rims& rims, const ObjectCamera& camera, const PicturePart& part) {
  HWY_DYNAMIC_DISPATCH(thinPart)(rims, camera, part);
}

}  // namespace grove::objects::lightfield

#endif  // HWY_ONCE
