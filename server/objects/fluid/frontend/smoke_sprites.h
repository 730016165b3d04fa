#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "objects/fluid/common/snapshot.h"
#include "pipeline/vector_bytes.h"
#include "world/camera.h"

namespace grove::objects::fluid {

/// Particles in one viewer's frame: gaussian sprites, stretched along their velocity on the screen (section 5.2). Every
/// array has one entry per particle plus up to a multiple of kMaxLanes undefined entries. Buffers only grow. Frontend,
/// one thread at a time.
///
/// Call order: project(), shape(), chooseDetail(), SmokeShading::shade(), collectVisible().
struct SmokeSprites {
  std::vector<float> x, y;          ///< centre, in pixels of the frame
  std::vector<float> depth;         ///< view depth in metres
  std::vector<float> radius;        ///< of the support, metres
  std::vector<float> heat;          ///< 0 = smoke .. 1 = flame
  std::vector<float> ember;         ///< 0 = no ember; else its brightness, up to 1
  std::vector<float> age;           ///< seconds
  std::vector<float> life;          ///< 0 = birth .. 1 = death
  std::vector<float> fade;          ///< 0..1: fades near the near plane and beyond both ends of a life
  std::vector<float> axisX, axisY;  ///< movement on the screen within the stretch time; metres, y down

  /// The weight of a pixel at (dx, dy) from the centre is (1 - q)^2, q = xx dx^2 + 2 xy dx dy + yy dy^2, 0 if q > 1.
  std::vector<float> xx, xy, yy;
  std::vector<float> halfWidth, halfHeight;  ///< of the bounding box, pixels
  std::vector<float> shrink;                 ///< weight lost to the target's smallest possible size

  std::vector<float> red, green, blue;  ///< display-encoded, times coverage
  std::vector<float> opacity;           ///< 0..1 at the centre
  std::vector<float> softness;          ///< metres over which it fades in front of a surface

  /// Random numbers 0..1, constant over a particle's life.
  std::vector<float> rank, chanceA, chanceB, chanceC;

  std::vector<std::uint32_t> seen;  ///< 1 if visible, else 0

  std::size_t count = 0;  ///< number of particles

  /// Most lanes of any processor.
  static constexpr std::size_t kMaxLanes = 16;

  void resize(std::size_t particles);

  /// Memory use.
  [[nodiscard]] std::size_t bytes() const noexcept {
    return pipeline::vectorBytes(x, y, depth, radius, heat, ember, age, life, fade, axisX, axisY, xx, xy, yy, halfWidth,
                                 halfHeight, shrink, red, green, blue, opacity, softness, rank, chanceA, chanceB,
                                 chanceC, seen);
  }
};

/// Sprites with less opacity are skipped.
inline constexpr float kMinOpacity = 1.0F / 512.0F;

/// Projects the particles, extrapolated by `lead` seconds, to the camera's screen.
void project(const FluidSnapshot& snapshot, const world::Camera& camera, float lead, SmokeSprites& sprites);

/// Computes the sprites' ellipses, none thinner than a pixel of a target that is `scale` times coarser than the frame.
void shape(const world::Camera& camera, int scale, SmokeSprites& sprites);

/// Writes the visible sprites to `order` and returns the bounds of the frame's pixels that they cover.
[[nodiscard]] world::Rect collectVisible(const world::Camera& camera, SmokeSprites& sprites,
                                         std::vector<std::uint32_t>& order);

}  // namespace grove::objects::fluid
