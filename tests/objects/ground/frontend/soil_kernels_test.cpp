#include "objects/ground/frontend/soil_kernels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "each_target.h"
#include "objects/ground/frontend/relief/relief_kernels.h"
#include "world/sky.h"

namespace grove::objects::ground {
namespace {

constexpr int kSoilTexels = 64;

Clearing wavy() {
  std::vector<std::uint32_t> texels;
  for (int y = 0; y < kSoilTexels; ++y) {
    for (int x = 0; x < kSoilTexels; ++x) {
      const auto wave = [&](float along, float across) {
        return 0.5F + 0.5F * std::sin(along * static_cast<float>(x)) * std::cos(across * static_cast<float>(y));
      };
      texels.push_back(packTexel(wave(0.3F, 0.1F), wave(0.2F, 0.4F), wave(0.15F, 0.2F), 0.5F * wave(0.1F, 0.3F)));
    }
  }
  return {Pyramid(kSoilTexels, std::move(texels)), 40.0F};
}

/// Straight, so that an entry more or less makes little difference.
ToneTable linear() {
  ToneTable tone;
  for (int i = 0; i < ToneTable::kEntries; ++i) {
    tone.levels[static_cast<std::size_t>(i)] = 255.0F * static_cast<float>(i) / ToneTable::kEntries;
  }
  return tone;
}

/// Channels of a level at a place in metres, bilinear.
std::array<float, 4> soilAt(const Clearing& clearing, int level, float metresX, float metresZ) {
  const int size = kSoilTexels >> level;
  const auto place = [&](float metres) {
    const float texel = (metres / clearing.metres + 0.5F) * static_cast<float>(size) - 0.5F;
    return std::clamp(texel, 0.0F, static_cast<float>(size - 1) - 0.001F);
  };
  const float x = place(metresX);
  const float y = place(metresZ);
  const int column = static_cast<int>(x);
  const int row = static_cast<int>(y);
  std::array<float, 4> mixed{};
  for (unsigned channel = 0; channel < 4; ++channel) {
    const auto texel = [&](int right, int down) {
      const int at = (row + down) * size + column + right;
      return static_cast<float>((clearing.pyramid.level(level)[at] >> (8U * channel)) & 0xFFU) / 255.0F;
    };
    const float fx = x - static_cast<float>(column);
    mixed[channel] = std::lerp(std::lerp(texel(0, 0), texel(1, 0), fx), std::lerp(texel(0, 1), texel(1, 1), fx),
                               y - static_cast<float>(row));
  }
  return mixed;
}

GroundLight lightWith(const ToneTable& tone) {
  GroundLight light{world::Sky()};
  light.tone = tone;
  return light;
}

struct Scene {
  Clearing clearing = wavy();
  GroundLight light = lightWith(linear());
  std::vector<world::PointLight> lights{{{1.0F, 0.8F, 4.0F}, {3.0F, 2.0F, 0.5F}}, {{-3.0F, 0.3F, 2.0F}, {0.2F, 1, 3}}};
  Frame frame;
  Row row;
};

/// What is displayed, 0..255, of blades whose root of albedo is `root` on a point of the row.
world::Vec3 shownAt(const Scene& scene, int level, float side, float root) {
  const Frame& frame = scene.frame;
  const Row& row = scene.row;
  const GroundLight& light = scene.light;
  const float x = frame.eyeX + row.depth * (row.ahead * frame.forwardX + side * frame.sideX);
  const float z = frame.eyeZ + row.depth * (row.ahead * frame.forwardZ + side * frame.sideZ);
  const auto [lit, open, dry, grass] = soilAt(scene.clearing, level, x, z);
  world::Vec3 lamps(0.0F);
  for (const world::PointLight& lamp : scene.lights) {
    const world::Vec3 to = lamp.position - world::Vec3(x, 0.0F, z);
    const float away = glm::dot(to, to) + 0.05F;
    lamps += lamp.colour * ((0.35F + 0.65F * to.y / std::sqrt(away)) / away);
  }
  const world::Vec3 ray(row.ahead * frame.forwardX + side * frame.sideX, row.rise,
                        row.ahead * frame.forwardZ + side * frame.sideZ);
  const float length = glm::length(ray);
  const float cosine = glm::dot(ray, light.sun) / length;
  const float c4 = std::pow(std::max(0.0F, cosine), 4.0F);
  const float c16 = std::pow(c4, 4.0F);
  const float cover = std::min(1.0F, 4.0F * grass);
  const float away = 0.5F - 0.5F * cosine / std::hypot(light.sun.x, light.sun.z);
  const float direct = lit * (0.26F + cover * (0.14F + 0.42F * away + 1.05F * c4 + 0.85F * c16));
  const float shade = open * open * (1.0F - 0.15F * cover);
  const world::Vec3 blades = glm::mix(world::Vec3(0.105F, 0.172F, 0.045F), world::Vec3(0.215F, 0.208F, 0.076F), dry);
  const world::Vec3 albedo = glm::mix(world::Vec3(0.250F, 0.165F, 0.100F), blades, cover);
  const float mist = world::mistAmount(row.depth);
  const float through = (1.0F - mist) * std::exp(light.logTransmittance * row.depth * length);
  const world::Vec3 radiance = through * albedo * (light.sunColour * direct + light.ambient * shade + lamps);
  const float glow = (0.36F * c4 + 0.30F * c16) / 0.66F;
  const world::Vec3 haze = (1.0F - through) * (light.hazeAside + light.hazeGlow * glow);
  const float scale = ToneTable::kScale * 255.0F / ToneTable::kEntries;
  return glm::min((haze + radiance * root * root) * scale, world::Vec3(255.0F));
}

/// Tolerance: an entry of the tone table.
TEST(SoilKernels, ParabolasMatchAtThreeRoots) {
  Scene scene;
  const world::Camera camera{
      .pose = {.position = {2.0F, 1.7F, 6.0F}, .yaw = 0.6F, .pitch = -0.2F}, .width = 1280, .height = 720};
  scene.frame = frameOf(camera);
  tests::onEachTarget([&] {
    for (const int y : {240, 300, 500, 719}) {
      for (const auto& [firstColumn, level] : {std::pair{0, 0}, {640, 1}}) {
        scene.row = rowAt(scene.frame, y);
        GroundRow ground;
        findGround(scene.frame, {}, y, firstColumn, nullptr, ground);
        SampledSoil soil;
        sampleSoil(scene.frame, ground, firstColumn, scene.clearing, level, scene.light, scene.lights, soil);
        for (int i = 0; i < kCoarseSamples; ++i) {
          const auto at = static_cast<std::size_t>(i);
          const float side =
              scene.frame.firstSide + static_cast<float>(firstColumn + i * kCoarse) * scene.frame.sideStep;
          for (const float root : {0.40F, 0.85F, 1.40F}) {
            const world::Vec3 exact = shownAt(scene, level, side, root);
            for (std::size_t channel = 0; channel < 3; ++channel) {
              const SampledSoil::Channel& curve = soil.channels[channel];
              const float shown = (curve.square[at] * root + curve.slope[at]) * root + curve.base[at] - 0.5F;
              ASSERT_NEAR(shown, exact[static_cast<int>(channel)], 0.15F) << y << ' ' << i << ' ' << root;
            }
          }
          const float x =
              scene.frame.eyeX + scene.row.depth * (scene.row.ahead * scene.frame.forwardX + side * scene.frame.sideX);
          const float z =
              scene.frame.eyeZ + scene.row.depth * (scene.row.ahead * scene.frame.forwardZ + side * scene.frame.sideZ);
          ASSERT_NEAR(soil.grass[at], soilAt(scene.clearing, level, x, z)[3], 1e-3F) << y << ' ' << i;
        }
      }
    }
  });
}

}  // namespace
}  // namespace grove::objects::ground
