#pragma once

#include <cstdint>

#include "world/geometry.h"

/// The one light of the world, shared by all renderers: a low sun in a soft evening sky, the fire, and haze. Radiance
/// is linear and relative (a white surface in full sun is about 1.8); toDisplay() makes the bytes that are streamed.
///
/// ambient(), hazeColour(), hazeAmount() and toDisplay() are restated in vectorised form in
/// raster/shading/vertex_light_kernels.cpp; its test holds them together.
namespace grove::world {

/// Unit vector towards the sun.
[[nodiscard]] Vec3 sunDirection() noexcept;

/// Radiance that a white diffuse surface facing the sun reflects of it.
[[nodiscard]] Vec3 sunColour() noexcept;

/// Radiance of the sky (without sun disc, clouds or landscape) in a unit direction; at the horizon and below it,
/// hazeColour().
[[nodiscard]] Vec3 skyRadiance(Vec3 direction) noexcept;

/// Radiance that a white diffuse surface with this unit normal reflects of the unobstructed sky and the ground's
/// bounce.
[[nodiscard]] Vec3 ambient(Vec3 normal) noexcept;

/// What the air adds: result = colour * (1 - amount) + hazeColour * amount. The direction is a unit vector from the
/// eye, the distance is in metres.
[[nodiscard]] Vec3 hazeColour(Vec3 direction) noexcept;
[[nodiscard]] float hazeAmount(float distance) noexcept;

/// Filmic curve and sRGB encoding of one linear channel to 0..1. The curve is K. Narkowicz, "ACES Filmic Tone Mapping
/// Curve" (2016).
[[nodiscard]] float toDisplay(float linear) noexcept;

/// 0xAABBGGRR (bytes R, G, B, A in memory) with A = 255.
[[nodiscard]] std::uint32_t toDisplayRgba(Vec3 linear) noexcept;

/// The fire in the midst of the stones, or a lantern.
struct PointLight {
  Vec3 position{0.0F};
  Vec3 colour{0.0F};  ///< radiance reflected by a white surface facing it at one metre
};

}  // namespace grove::world
