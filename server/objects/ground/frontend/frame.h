#pragma once

#include "world/camera.h"

namespace grove::objects::ground {

inline constexpr int kTile = 160;  ///< columns per strip

/// Distance of the meadow's far edge, in metres; the forest of the sky's panorama begins there.
inline constexpr float kFarthest = 140.0F;

/// Values that the rows of a frame share. The camera never rolls, so all pixels of a row meet the plane at one depth,
/// on a line. For one metre of view depth, a pixel's ray goes `ahead * forward + side * sideways` in the plane and
/// `rise` upwards.
struct Frame {
  float eyeX = 0.0F, eyeY = 0.0F, eyeZ = 0.0F;
  float forwardX = 0.0F, forwardZ = 0.0F;         ///< unit, horizontal
  float sideX = 0.0F, sideZ = 0.0F;               ///< unit, horizontal
  float firstSide = 0.0F, sideStep = 0.0F;        ///< of the frame's columns
  float firstInverse = 0.0F, inverseStep = 0.0F;  ///< 1/depth of the frame's rows
  float firstAhead = 0.0F, aheadStep = 0.0F;      ///< of the frame's rows
  float focal = 0.0F;                             ///< pixels
};

/// `camera`'s eye must be above the ground.
[[nodiscard]] Frame frameOf(const world::Camera& camera);

/// The points on the plane at the centres of a row of pixels.
struct Row {
  int row = 0;
  float depth = 0.0F;
  float ahead = 0.0F;
  float rise = 0.0F;
  float pixelsPerMetre = 0.0F;  ///< of something upright on this row's ground
  float across = 0.0F;          ///< metres between neighbouring pixels
  float along = 0.0F;           ///< metres between this row and the next
};

/// Rows above the meadow's far edge lie slightly beyond it.
[[nodiscard]] Row rowAt(const Frame& frame, int row) noexcept;

}  // namespace grove::objects::ground
