#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "objects/fluid/common/snapshot.h"
#include "pipeline/vector_bytes.h"
#include "world/camera.h"

namespace grove::objects::fluid {

/// Particles as one viewer sees them: gaussian sprites that are stretched along their velocity on the screen (section
/// 5.2). One entry per particle in every array, and up to a multiple of kMaxLanes entries that mean nothing. Buffers
/// only grow. Frontend, one thread at a time.
///
/// Made in the order project(), shape(), chooseDetail(), SmokeShading::shade(), collectVisible().
struct SmokeSprites {
  std::vector<float> x, y;          ///< middle, in pixels of the frame
  std::vector<float> depth;         ///< view depth in metres
  std::vector<float> radius;        ///< of the support, metres
  std::vector<float> heat;          ///< 0 = smoke .. 1 = flame
  std::vector<float> life;          ///< 0 = born .. 1 = gone
  std::vector<float> fade;          ///< 0..1: towards the near plane and beyond the ends of a life
  std::vector<float> axisX, axisY;  ///< how far it moves on the screen within the stretch time; in metres, y down

  /// The weight of a pixel at (dx, dy) from the middle is (1 - q)^2, q = xx dx^2 + 2 xy dx dy + yy dy^2, 0 if q > 1.
  std::vector<float> xx, xy, yy;
  std::vector<float> halfWidth, halfHeight;  ///< of the box around it, pixels
  std::vector<float> shrink;                 ///< weight lost to the smallest size that the target can show

  std::vector<float> red, green, blue;  ///< display-encoded, times coverage
  std::vector<float> opacity;           ///< 0..1 at the middle
  std::vector<float> softness;          ///< metres over which it fades in front of a surface

  /// Random numbers 0..1 that stay with a particle.
  std::vector<float> rank, chanceA, chanceB, chanceC;

  std::vector<std::uint32_t> seen;  ///< 1 if it shows anything, else 0

  std::size_t count = 0;  ///< of the particles

  /// As many as any processor works on at once.
  static constexpr std::size_t kMaxLanes = 16;

  void resize(std::size_t particles);

  /// Memory that they take.
  [[nodiscard]] std::size_t bytes() const noexcept {
    return pipeline::vectorBytes(x, y, depth, radius, heat, life, fade, axisX, axisY, xx, xy, yy, halfWidth, halfHeight,
                                 shrink, red, green, blue, opacity, softness, rank, chanceA, chanceB, chanceC, seen);
  }
};

/// Sprites of less opacity are not worth a look.
inline constexpr float kMinOpacity = 1.0F / 512.0F;

/// Places the particles, moved on by `lead` seconds, on the camera's screen.
void project(const FluidSnapshot& snapshot, const world::Camera& camera, float lead, SmokeSprites& sprites);

/// Gives the sprites their ellipses, none thinner than a pixel of a target that is `scale` times coarser than the
/// frame.
void shape(const world::Camera& camera, int scale, SmokeSprites& sprites);

/// The sprites that show anything, into `order`, and the pixels of the frame that they cover.
[[nodiscard]] world::Rect collectVisible(const world::Camera& camera, SmokeSprites& sprites,
                                         std::vector<std::uint32_t>& order);

}  // namespace grove::objects::fluid
