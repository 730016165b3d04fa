#pragma once

#include "objects/fluid/frontend/smoke_sprites.h"

/// The loops over all sprites of a viewer.
namespace grove::objects::fluid {

/// A camera in plain numbers. The screen's middle is in pixels, the nearest depth in metres.
struct SmokeLens {
  explicit SmokeLens(const world::Camera& camera);

  world::Vec3 eye, right, up, forward;
  float focal;  ///< pixels
  float middleX, middleY;
  float nearDepth;
};

/// See project(); the sprites have been resized.
void projectSprites(const FluidSnapshot& snapshot, const SmokeLens& lens, float lead, SmokeSprites& sprites);

/// See shape(); no ellipse becomes thinner than `minPixels`.
void shapeSprites(const SmokeLens& lens, float minPixels, SmokeSprites& sprites);

/// In pixels of the frame.
struct SpriteBounds {
  float left, top, right, bottom;
};

/// What drawing the sprites will cost, in blocks of 16 pixels of a target `scale` times coarser than the frame.
struct SpriteBlocks {
  float smoke, flame;
  SpriteBounds covered;  ///< right < left if nothing is
};

/// Estimated from the boxes around the sprites, clipped to a frame of width x height pixels.
[[nodiscard]] SpriteBlocks estimateBlocks(const SmokeSprites& sprites, float width, float height, float scale);

/// Marks those sprites as seen that show anything on a frame of width x height pixels; the box around them, not
/// clipped.
SpriteBounds markSeen(float width, float height, float nearDepth, float farDepth, SmokeSprites& sprites);

}  // namespace grove::objects::fluid
