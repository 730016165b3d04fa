#include "objects/fluid/frontend/smoke_shading_kernels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "each_target.h"
#include "objects/fluid/frontend/smoke_scene.h"
#include "objects/fluid/frontend/sprites_by_hand.h"
#include "world/sky.h"

namespace grove::objects::fluid::testing {
namespace {

/// What scatterSunAndSky() and addPointLight() say of one sprite.
world::Vec3 scattered(const FluidSnapshot& snapshot, std::size_t i, world::Vec3 eye, world::Vec3 sun,
                      world::Vec3 sunColour, const SmokeSky& sky, const world::PointLight& light) {
  const world::Vec3 at(snapshot.x[i], snapshot.y[i], snapshot.z[i]);
  const float base = 1.0F + 0.55F * 0.55F - 2.0F * 0.55F * glm::dot(glm::normalize(at - eye), sun);
  const float phase = (1.0F - 0.55F * 0.55F) / std::pow(base, 1.5F);
  const float square = glm::dot(at - light.position, at - light.position);
  const float up = std::max(0.0F, at.y - light.position.y);
  const float thick = 1.0F + 0.5F * up * up;
  return sunColour * snapshot.sunLight[i] * (0.26F + 0.3F * snapshot.sunLight[i] * phase) + sky.side +
         sky.above * snapshot.skyLight[i] +
         light.colour * (0.14F / ((0.3F + square) * (1.0F + 0.15F * square) * thick * thick));
}

/// Fails if a target lights, encodes or thins sprites otherwise. A colour may come from the neighbouring entry of the
/// table, which differs by half a 255th in the dark.
TEST(SmokeShadingKernels, MatchesScalarOnEveryTarget) {
  constexpr float kTime = 12.25F;
  std::vector<float> display(kDisplaySteps + 1);
  for (std::size_t i = 0; i <= kDisplaySteps; ++i) {
    const float root = static_cast<float>(i) / static_cast<float>(kDisplaySteps);
    display[i] = world::toDisplay(kBrightestSmoke * root * root);
  }
  const auto encode = [&](float linear) {
    return display[static_cast<std::size_t>(std::sqrt(saturate(linear / kBrightestSmoke)) * kDisplaySteps)];
  };
  const world::Vec3 eye = camera().pose.position;
  const world::Vec3 sun = world::Sky().sun;
  const world::Vec3 sunColour(1.9F, 1.1F, 0.5F);
  const SmokeSky sky{.above = {0.12F, 0.16F, 0.2F}, .side = {0.18F, 0.2F, 0.22F}};
  const world::PointLight light{{0.0F, 0.5F, 0.0F}, {3.0F, 1.5F, 0.5F}};
  for (const float kept : {1.0F, 0.3F}) {
    for (const int count : {1, 3, 16, 17, 333}) {
      const auto snapshot = makePlume(count);
      tests::onEachTarget([&] {
        SmokeSprites s;
        project(*snapshot, camera(), kLead, s);
        shape(camera(), kScale, s);
        scatterSunAndSky(*snapshot, eye, sun, sunColour, sky, s);
        addPointLight(*snapshot, light, s);
        for (std::size_t i = 0; i < s.count; ++i) {
          const world::Vec3 expected = scattered(*snapshot, i, eye, sun, sunColour, sky, light);
          expectNear(s.red[i], expected.r, "scattered red", i);
          expectNear(s.green[i], expected.g, "scattered green", i);
          expectNear(s.blue[i], expected.b, "scattered blue", i);
        }
        const SmokeSprites lit = s;
        finishSprites(*snapshot, kept, kTime, display.data(), s);
        for (std::size_t i = 0; i < s.count; ++i) {
          const float life = s.life[i];
          const float temperature = snapshot->temperature[i];
          const float albedo = (0.28F + 0.4F * std::sqrt(life)) * (0.85F + 0.3F * s.chanceC[i]);
          const float clear = 1.0F - 0.75F * saturate((temperature - 0.1F) * 3.0F);
          const float thick =
              0.115F * clear * saturate(life * 12.0F) * std::pow(1.0F - life, 1.5F) * (0.55F + 0.9F * s.chanceB[i]);
          const float chosen = kept >= 1.0F ? 1.0F : saturate((kept * 1.05F - s.rank[i]) * 20.0F);
          const float dense = std::min(0.85F, thick / kept / (1.0F + 0.5F * thick * (1.0F / kept - 1.0F)));
          const float smoke = (1.0F - s.heat[i]) * dense * chosen * s.fade[i] * s.shrink[i];
          const float beat = kTime * (2.0F + 2.0F * s.chanceC[i]) + 7.0F * s.chanceB[i];
          const float turn = beat - std::floor(beat);
          const float flicker = 0.7F + 1.2F * turn * (1.0F - turn);
          const float glow = saturate((temperature - 0.3F) / 0.7F);
          const float power = (0.6F + 3.4F * glow * glow) * flicker;
          const float flame =
              s.heat[i] * saturate(life * 30.0F) * (0.08F + 0.13F * s.chanceB[i]) * flicker * s.fade[i] * s.shrink[i];
          const auto mixed = [&](float radiance, float tint, float share) {
            return smoke * encode(albedo * radiance * tint) + flame * encode(power * share);
          };
          if (s.ember[i] > 0.0F) {
            const float covers = std::min(1.0F, 2.5F * s.ember[i]) * s.fade[i] * std::sqrt(s.shrink[i]);
            const float hot = 1.0F + 3.0F * s.ember[i];
            EXPECT_NEAR(s.red[i], covers * encode(hot), 0.005F) << i;
            EXPECT_NEAR(s.green[i], covers * encode(0.14F * hot), 0.005F) << i;
            EXPECT_NEAR(s.blue[i], covers * encode(0.02F * hot), 0.005F) << i;
            EXPECT_NEAR(s.opacity[i], 0.5F * covers, 2.0e-5F) << i;
            continue;
          }
          const float max = 0.004F * (smoke + flame) + 2.0e-5F;
          EXPECT_NEAR(s.red[i], mixed(lit.red[i], 1.0F, 1.0F), max) << i;
          EXPECT_NEAR(s.green[i], mixed(lit.green[i], 1.01F, 0.05F + 0.23F * glow), max) << i;
          EXPECT_NEAR(s.blue[i], mixed(lit.blue[i], 1.06F, 0.006F + 0.05F * glow * glow * glow), max) << i;
          EXPECT_NEAR(s.opacity[i], smoke + 0.6F * flame, 2.0e-5F) << i;
          expectNear(s.softness[i], 0.08F + 0.55F * s.radius[i], "softness", i);
        }
      });
    }
  }
}

/// The light of one sprite without fires or lanterns, seen against the sun.
world::Vec3 litBy(float skyLight, float sunLight) {
  const world::Sky sky;
  FluidSnapshot snapshot;
  add(snapshot, {.at = {0.0F, 2.0F, 0.0F}});
  snapshot.skyLight[0] = skyLight;
  snapshot.sunLight[0] = sunLight;
  SmokeSprites sprites;
  sprites.resize(1);
  const SmokeSky colours{.above = {0.12F, 0.12F, 0.15F}, .side = {0.18F, 0.17F, 0.18F}};
  scatterSunAndSky(snapshot, world::Vec3(0.0F, 2.0F, 0.0F) - 3.0F * sky.sun, sky.sun, sky.sunColour, colours, sprites);
  return {sprites.red[0], sprites.green[0], sprites.blue[0]};
}

// Fault: a column's middle, where little sun and no sky from above arrive, is brown or black instead of grey.
TEST(SmokeShading, SkyLightsTheMiddleOfAColumn) {
  const world::Vec3 middle = litBy(0.0F, 0.06F);
  EXPECT_LT(middle.r / middle.b, 1.35F);
  EXPECT_GT(middle.b, 0.5F * litBy(1.0F, 0.0F).b);
}

// Fault: light that has crossed much smoke still shines forwards, as the sun's own ray does.
TEST(SmokeShading, OnlyTheSunsOwnRayShinesForwards) {
  const float none = litBy(0.0F, 0.0F).r;
  EXPECT_GT(litBy(0.0F, 1.0F).r - none, 2.0F * 10.0F * (litBy(0.0F, 0.1F).r - none));
}

// Fault: a fire lights the smoke high above it as if there were no smoke in between.
TEST(SmokeShading, SmokeKeepsTheFireFromWhatIsHighAboveIt) {
  const auto litAt = [](world::Vec3 place) {
    FluidSnapshot snapshot;
    add(snapshot, {.at = place});
    SmokeSprites sprites;
    sprites.resize(1);
    addPointLight(snapshot, {{0.0F, 0.5F, 0.0F}, {3.0F, 1.5F, 0.5F}}, sprites);
    return sprites.red[0];
  };
  EXPECT_LT(litAt({0.0F, 2.5F, 0.0F}), 0.2F * litAt({2.0F, 0.5F, 0.0F}));
  EXPECT_GT(litAt({0.0F, 0.8F, 0.0F}), 0.8F * litAt({0.3F, 0.5F, 0.0F}));
}

}  // namespace
}  // namespace grove::objects::fluid::testing
