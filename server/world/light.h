#pragma once

#include <cstdint>

#include "world/geometry.h"

/// How radiance is weakened by the air and turned into the bytes that are streamed, and the lights that stand in a
/// world or are carried through it. See world/sky.h for the sun.
namespace grove::world {

/// The share of a colour that the air replaces by its own over so many metres, see Sky::hazeColour(). Restated in
/// vectorised form as toDisplay() is.
[[nodiscard]] float hazeAmount(float distance) noexcept;

/// Filmic curve and sRGB encoding of one linear channel to 0..1. The curve is K. Narkowicz, "ACES Filmic Tone Mapping
/// Curve" (2016). Restated in vectorised form in raster/shading/vertex_light_kernels.cpp; its test holds them together.
[[nodiscard]] float toDisplay(float linear) noexcept;

/// 0xAABBGGRR (bytes R, G, B, A in memory) with A = 255.
[[nodiscard]] std::uint32_t toDisplayRgba(Vec3 linear) noexcept;

/// The fire in the midst of the stones, or a lantern.
struct PointLight {
  Vec3 position{0.0F};
  Vec3 colour{0.0F};  ///< radiance reflected by a white surface facing it at one metre
};

}  // namespace grove::world
