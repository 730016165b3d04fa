#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "objects/lightfield/format/view_camera.h"
#include "objects/lightfield/sun_grid.h"
#include "world/camera.h"
#include "world/light.h"

namespace grove::objects::lightfield {

/// Metres at which a lamp is no longer seen.
inline constexpr float kLampReach = 7.0F;
/// Metres: for pixels that show nothing.
inline constexpr float kRelightFarthest = 1.0e4F;

/// A part of a picture as a raster::Image has it, rows `stride` pixels apart; `rect` is in pixels of `camera`.
struct PicturePart {
  std::uint32_t* colour = nullptr;
  const float* depth = nullptr;
  std::ptrdiff_t stride = 0;
  world::Rect rect;
};

/// Darkens what the sun does not reach: colour * (shade + (1 - shade) * share of the sun), the shade being the sky's
/// blue light and the share trilinear. Not for a `whole` grid.
void shadePart(const SunGrid& sun, const ObjectCamera& camera, const PicturePart& part);

/// Adds the lamps' light: colour + colour * gain, at most the coverage, where the gain of a lamp at a distance d is
/// its colour * (1 - (d / kLampReach)^2)^2 / (d^2 + a lamp's size).
void lightPart(std::span<const world::PointLight> lamps, const ObjectCamera& camera, const PicturePart& part);

/// Depths of what a part shows; farthest is 0 if that is nothing.
struct DepthRange {
  float nearest = kRelightFarthest;
  float farthest = 0.0F;
};
[[nodiscard]] DepthRange depthRange(const PicturePart& part);

}  // namespace grove::objects::lightfield
