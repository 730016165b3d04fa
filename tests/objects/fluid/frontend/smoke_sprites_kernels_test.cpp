#include "objects/fluid/frontend/smoke_sprites_kernels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "each_target.h"
#include "objects/fluid/frontend/sprites_by_hand.h"

namespace grove::objects::fluid::testing {
namespace {

std::uint32_t hash(std::uint32_t seed) {
  seed = (seed ^ seed >> 16U) * 0x7feb352dU;
  seed = (seed ^ seed >> 15U) * 0x846ca68bU;
  return seed ^ seed >> 16U;
}

float lot(std::uint32_t bits) { return static_cast<float>(bits & 0xFFFFU) / 65536.0F; }

/// What projectSprites() says of one sprite.
void expectProjected(const FluidSnapshot& snapshot, const world::Camera& eye, const SmokeSprites& sprites,
                     std::size_t i) {
  const std::uint32_t first = hash(static_cast<std::uint32_t>(std::lround(snapshot.lifetime[i] * 4096.0F)));
  const std::uint32_t second = hash(first ^ 0x9e3779b9U);
  EXPECT_EQ(sprites.rank[i], lot(first));
  EXPECT_EQ(sprites.chanceA[i], lot(first >> 16U));
  EXPECT_EQ(sprites.chanceB[i], lot(second));
  EXPECT_EQ(sprites.chanceC[i], lot(second >> 16U));

  const float now = snapshot.age[i] + kLead;
  const bool ember = sprites.chanceB[i] < 0.012F;
  expectNear(sprites.ember[i], ember ? std::max(1e-4F, 1.0F - now / 1.8F) : 0.0F, "ember", i);
  expectNear(sprites.age[i], now, "age", i);
  const world::Vec3 velocity{snapshot.velocityX[i], snapshot.velocityY[i], snapshot.velocityZ[i]};
  const world::Vec3 way = world::Vec3(snapshot.x[i], snapshot.y[i], snapshot.z[i]) + kLead * velocity +
                          (ember ? 0.7F * now * world::Vec3(sprites.chanceA[i] - 0.5F, 0.0F, sprites.chanceC[i] - 0.5F)
                                 : world::Vec3(0.0F)) -
                          eye.pose.position;
  const auto onScreen = [&](world::Vec3 v) {
    return world::Vec3(glm::dot(v, eye.pose.right()), -glm::dot(v, eye.pose.up()), glm::dot(v, eye.pose.forward()));
  };
  const world::Vec3 at = onScreen(way);
  const world::Vec3 speed = onScreen(velocity);
  const float nearest = std::max(at.z, eye.nearDepth);
  expectNear(sprites.x[i], 0.5F * static_cast<float>(eye.width) + eye.focal() * at.x / nearest, "x", i);
  expectNear(sprites.y[i], 0.5F * static_cast<float>(eye.height) + eye.focal() * at.y / nearest, "y", i);
  expectNear(sprites.depth[i], at.z, "depth", i);

  const float spent = now / snapshot.lifetime[i];
  const float t = saturate((snapshot.temperature[i] - 0.28F) / 0.3F);
  const float heat = t * t * (3.0F - 2.0F * t);
  const float spread = 0.6F + 0.8F * sprites.chanceA[i];
  const float smoke = (0.09F + 0.36F * std::sqrt(saturate(spent))) * spread;
  const float flame = (0.055F + 0.085F * saturate(4.0F * spent)) * spread;
  const float size = ember ? 0.01F : smoke + (flame - smoke) * heat;
  const float near = 0.2F + (ember ? 1.0F : 1.2F * size);
  expectNear(sprites.life[i], saturate(spent), "life", i);
  expectNear(sprites.heat[i], heat, "heat", i);
  expectNear(sprites.radius[i], size, "radius", i);
  expectNear(sprites.fade[i], spent < 1.0F ? saturate((at.z - eye.nearDepth - 0.1F) / near) : 0.0F, "fade", i);
  expectNear(sprites.axisX[i],
             0.11F * (speed.x - at.x / nearest * speed.z) + 0.25F * size * (sprites.chanceA[i] - 0.5F), "axisX", i);
  expectNear(sprites.axisY[i],
             0.11F * (speed.y - at.y / nearest * speed.z) + 0.25F * size * (sprites.chanceB[i] - 0.5F), "axisY", i);
}

/// What shapeSprites() says: an ellipse whose long axis is turned into (axisX, axisY).
void expectShaped(const world::Camera& eye, const SmokeSprites& sprites, float minPixels, std::size_t i) {
  const float length = std::hypot(sprites.axisX[i], sprites.axisY[i]) + 1e-6F;
  const float c = sprites.axisX[i] / length;
  const float s = sprites.axisY[i] / length;
  const float ratio = std::min(length / sprites.radius[i], 2.5F);
  const float pixels = eye.focal() * sprites.radius[i] / std::max(sprites.depth[i], eye.nearDepth);
  const float trueMajor = pixels * (1.0F + (0.55F + 0.25F * sprites.heat[i]) * ratio);
  const float trueMinor = pixels / (1.0F + 0.3F * ratio);
  const float major = std::max(trueMajor, minPixels);
  const float minor = std::max(trueMinor, minPixels);
  expectNear(sprites.shrink[i], trueMajor * trueMinor / (major * minor), "shrink", i);
  expectNear(sprites.halfWidth[i], std::hypot(c * major, s * minor), "half width", i);
  expectNear(sprites.halfHeight[i], std::hypot(s * major, c * minor), "half height", i);
  expectNear(sprites.xx[i], c * c / (major * major) + s * s / (minor * minor), "xx", i);
  expectNear(sprites.xy[i], c * s / (major * major) - c * s / (minor * minor), "xy", i);
  expectNear(sprites.yy[i], s * s / (major * major) + c * c / (minor * minor), "yy", i);
}

/// Fails if a target projects, shapes or draws lots otherwise, at the ends of the arrays too.
TEST(SmokeSpritesKernels, PlacementMatchesScalarOnEveryTarget) {
  const SmokeLens lens(camera());
  for (const int count : {1, 3, 16, 17, 333}) {
    const auto snapshot = makePlume(count);
    tests::onEachTarget([&] {
      SmokeSprites sprites;
      sprites.resize(snapshot->count());
      projectSprites(*snapshot, lens, kLead, sprites);
      shapeSprites(lens, 1.1F * kScale, sprites);
      for (std::size_t i = 0; i < snapshot->count(); ++i) {
        expectProjected(*snapshot, camera(), sprites, i);
        expectShaped(camera(), sprites, 1.1F * kScale, i);
      }
      EXPECT_TRUE(count < 333 || std::ranges::count(sprites.ember, 0.0F) < count) << "no ember";
    });
  }
}

/// Fails if a target counts blocks, marks sprites or bounds them otherwise; some are beyond the frame's edges.
TEST(SmokeSpritesKernels, SumsMatchScalarOnEveryTarget) {
  constexpr float kWidth = 150.0F;
  constexpr float kHeight = 90.0F;
  for (const int count : {1, 3, 16, 17, 333}) {
    const auto snapshot = makePlume(count);
    tests::onEachTarget([&] {
      SmokeSprites sprites;
      project(*snapshot, camera(), kLead, sprites);
      shape(camera(), kScale, sprites);
      for (std::size_t i = 0; i < sprites.count; ++i) sprites.opacity[i] = i % 5 == 3 ? 0.0F : 0.5F;
      double smoke = 0.0;
      double flame = 0.0;
      SpriteBounds covered{kWidth, kHeight, 0.0F, 0.0F};
      SpriteBounds around = covered;
      std::vector<std::uint32_t> seen(sprites.count, 0);
      for (std::size_t i = 0; i < sprites.count; ++i) {
        const SpriteBounds box{sprites.x[i] - sprites.halfWidth[i], sprites.y[i] - sprites.halfHeight[i],
                               sprites.x[i] + sprites.halfWidth[i], sprites.y[i] + sprites.halfHeight[i]};
        const auto widen = [&](SpriteBounds& by) {
          by = {std::min(by.left, box.left), std::min(by.top, box.top), std::max(by.right, box.right),
                std::max(by.bottom, box.bottom)};
        };
        if (box.right <= 0.0F || box.bottom <= 0.0F || box.left >= kWidth || box.top >= kHeight) continue;
        if (sprites.depth[i] >= 0.1F && sprites.depth[i] <= 6.0F && sprites.opacity[i] >= kMinOpacity) {
          seen[i] = 1;
          widen(around);
        }
        if (sprites.fade[i] <= 0.0F) continue;
        widen(covered);
        const double columns = std::min(box.right, kWidth) - std::max(box.left, 0.0F);
        const double rows = std::min(box.bottom, kHeight) - std::max(box.top, 0.0F);
        const double blocks = rows / kScale * (0.7 * columns / (16.0 * kScale) + 0.8);
        flame += static_cast<double>(sprites.heat[i]) * blocks;
        smoke += (1.0 - static_cast<double>(sprites.heat[i])) * blocks;
      }
      const SpriteBlocks blocks = estimateBlocks(sprites, kWidth, kHeight, kScale);
      EXPECT_NEAR(static_cast<double>(blocks.smoke), smoke, 1e-4 * smoke);
      EXPECT_NEAR(static_cast<double>(blocks.flame), flame, 1e-4 * (smoke + flame));
      const SpriteBounds marked = markSeen(kWidth, kHeight, 0.1F, 6.0F, sprites);
      for (const auto& [one, other] : {std::pair{blocks.covered, covered}, {marked, around}}) {
        EXPECT_FLOAT_EQ(one.left, other.left);
        EXPECT_FLOAT_EQ(one.top, other.top);
        EXPECT_FLOAT_EQ(one.right, other.right);
        EXPECT_FLOAT_EQ(one.bottom, other.bottom);
      }
      sprites.seen.resize(sprites.count);
      EXPECT_EQ(sprites.seen, seen);
    });
  }
}

}  // namespace
}  // namespace grove::objects::fluid::testing
