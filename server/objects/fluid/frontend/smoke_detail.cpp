#include "objects/fluid/frontend/smoke_detail.h"

#include <algorithm>

#include "objects/fluid/frontend/smoke_sprites_kernels.h"

namespace grove::objects::fluid {
namespace {

constexpr float kMinKeptAtHalf = 0.15F;
constexpr float kBlocksPerPixel = 1.0F / 14.0F;
constexpr float kMinKept = 0.07F;

}  // namespace

SmokeDetail chooseDetail(const world::Camera& camera, const SmokeSprites& sprites, float budget,
                         const SmokeDetail& before) {
  const auto width = static_cast<float>(camera.width);
  const auto height = static_cast<float>(camera.height);
  const auto kept = [&](int scale) {
    const SpriteBlocks blocks = estimateBlocks(sprites, width, height, static_cast<float>(scale));
    const SpriteBounds& box = blocks.covered;
    const float pixels = std::max(0.0F, std::min(box.right, width) - std::max(box.left, 0.0F)) *
                         std::max(0.0F, std::min(box.bottom, height) - std::max(box.top, 0.0F));
    const float upsampling = pixels * kBlocksPerPixel;
    return std::clamp((budget - blocks.flame - upsampling) / std::max(blocks.smoke, 1.0F), kMinKept, 1.0F);
  };
  const float atHalf = kept(2);
  if (atHalf > kMinKeptAtHalf * (before.scale == 2 ? 0.85F : 1.15F)) return {2, atHalf};
  return {4, kept(4)};
}

}  // namespace grove::objects::fluid
