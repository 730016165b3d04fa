#pragma once

#include <cstdint>

#include "world/geometry.h"

/// Attenuation of radiance by air and its conversion to streamed bytes, and the lights that stand in a world or that
/// visitors carry. See world/sky.h for the sun.
namespace grove::world {

/// The share of a colour that this many metres of air replace by haze, see Sky::hazeColour(). Has a vectorised copy,
/// like toDisplay().
[[nodiscard]] float hazeAmount(float distance) noexcept;

/// The share of the ground's colour at this distance that mist replaces by haze, in addition to air: none nearby, most of
/// it far away, so that a meadow has no visible end. It grows smoothly from kMistBegins to kMistIsThickest, in metres,
/// and thins out with height, up to kMistTop metres. Has a vectorised copy in the ground's soil_kernels.cpp.
[[nodiscard]] float mistAmount(float distance) noexcept;
inline constexpr float kMostMist = 0.80F;
inline constexpr float kMistBegins = 28.0F;
inline constexpr float kMistIsThickest = 140.0F;
inline constexpr float kMistTop = 10.0F;

/// Filmic curve and sRGB encoding of one linear channel to 0..1. The curve is that of K. Narkowicz, "ACES Filmic Tone
/// Mapping Curve" (2016), but linear in the shadows, where his is black: a grove is mostly shadow. Has a vectorised
/// copy in raster/shading/vertex_light_kernels.cpp, whose test compares both.
[[nodiscard]] float toDisplay(float linear) noexcept;

/// 0xAABBGGRR (bytes R, G, B, A in memory) with A = 255.
[[nodiscard]] std::uint32_t toDisplayRgba(Vec3 linear) noexcept;

/// The fire amid the stones, or a lantern.
struct PointLight {
  Vec3 position{0.0F};
  Vec3 colour{0.0F};  ///< radiance reflected by a white surface facing it at one metre
};

}  // namespace grove::world
