#pragma once

#include "objects/fluid/frontend/smoke_sprites.h"

/// Kernels over all sprites of a viewer.
namespace grove::objects::fluid {

/// A camera as plain numbers. The screen's centre is in pixels, the nearest depth in metres.
struct SmokeLens {
  explicit SmokeLens(const world::Camera& camera);

  world::Vec3 eye, right, up, forward;
  float focal;  ///< pixels
  float middleX, middleY;
  float nearDepth;
};

/// See project(); the sprites already have their size.
void projectSprites(const FluidSnapshot& snapshot, const SmokeLens& lens, float lead, SmokeSprites& sprites);

/// See shape(); ellipses are at least `minPixels` thick.
void shapeSprites(const SmokeLens& lens, float minPixels, SmokeSprites& sprites);

/// In pixels of the frame.
struct SpriteBounds {
  float left, top, right, bottom;
};

/// Cost of drawing the sprites, in blocks of 16 pixels of a target `scale` times coarser than the frame.
struct SpriteBlocks {
  float smoke, flame;
  SpriteBounds covered;  ///< right < left if empty
};

/// Estimates the cost from the sprites' bounding boxes, clipped to a frame of width x height pixels.
[[nodiscard]] SpriteBlocks estimateBlocks(const SmokeSprites& sprites, float width, float height, float scale);

/// Marks the sprites that are visible in a frame of width x height pixels; returns their bounds, not clipped.
SpriteBounds markSeen(float width, float height, float nearDepth, float farDepth, SmokeSprites& sprites);

}  // namespace grove::objects::fluid
