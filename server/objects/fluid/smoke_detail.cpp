#include "objects/fluid/smoke_detail.h"

#include <algorithm>

namespace grove::objects::fluid {
namespace {

constexpr float kLeastKeptAtHalf = 0.2F;
constexpr float kBlocksPerPixel = 1.0F / 14.0F;
constexpr float kLeastKept = 0.02F;

struct Blocks {
  float smoke = 0.0F;
  float flame = 0.0F;
  float upsampling = 0.0F;  ///< of all pixels that any sprite covers, as so many blocks
};

/// Estimated from the boxes around the sprites, clipped to the frame.
Blocks estimate(const world::Camera& camera, const SmokeSprites& sprites, float scale) {
  const float width = static_cast<float>(camera.width);
  const float height = static_cast<float>(camera.height);
  const float* const x = sprites.x.data();
  const float* const y = sprites.y.data();
  const float* const halfWidth = sprites.halfWidth.data();
  const float* const halfHeight = sprites.halfHeight.data();
  const float* const heat = sprites.heat.data();
  const float* const fade = sprites.fade.data();
  float smoke = 0.0F;
  float flame = 0.0F;
  float left = width;
  float top = height;
  float right = 0.0F;
  float bottom = 0.0F;
  const std::size_t count = sprites.count;
#pragma GCC ivdep
  for (std::size_t i = 0; i < count; ++i) {
    const float columns = std::min(x[i] + halfWidth[i], width) - std::max(x[i] - halfWidth[i], 0.0F);
    const float rows = std::min(y[i] + halfHeight[i], height) - std::max(y[i] - halfHeight[i], 0.0F);
    const bool seen = columns > 0.0F && rows > 0.0F && fade[i] > 0.0F;
    const float blocks = seen ? (rows / scale) * (0.7F * columns / (16.0F * scale) + 0.8F) : 0.0F;
    // Not std::min, whose references GCC does not vectorise as a reduction.
    const float thisLeft = seen ? x[i] - halfWidth[i] : width;
    const float thisTop = seen ? y[i] - halfHeight[i] : height;
    const float thisRight = seen ? x[i] + halfWidth[i] : 0.0F;
    const float thisBottom = seen ? y[i] + halfHeight[i] : 0.0F;
    left = thisLeft < left ? thisLeft : left;
    top = thisTop < top ? thisTop : top;
    right = thisRight > right ? thisRight : right;
    bottom = thisBottom > bottom ? thisBottom : bottom;
    flame += heat[i] * blocks;
    smoke += (1.0F - heat[i]) * blocks;
  }
  const float covered = std::max(0.0F, std::min(right, width) - std::max(left, 0.0F)) *
                        std::max(0.0F, std::min(bottom, height) - std::max(top, 0.0F));
  return {smoke, flame, covered * kBlocksPerPixel};
}

}  // namespace

SmokeDetail chooseDetail(const world::Camera& camera, const SmokeSprites& sprites, float budget,
                         const SmokeDetail& before) {
  const auto kept = [&](int scale) {
    const Blocks blocks = estimate(camera, sprites, static_cast<float>(scale));
    return std::clamp((budget - blocks.flame - blocks.upsampling) / std::max(blocks.smoke, 1.0F), kLeastKept, 1.0F);
  };
  const float atHalf = kept(2);
  if (atHalf > kLeastKeptAtHalf * (before.scale == 2 ? 0.85F : 1.15F)) return {2, atHalf};
  return {4, kept(4)};
}

}  // namespace grove::objects::fluid
