#include "raster/shading/vertex_light_kernels.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "each_target.h"
#include "raster/shading/vertex_light.h"

namespace grove::raster {
namespace {

using Vec3d = glm::dvec3;
using world::Vec3;

constexpr std::size_t kVertices = 301;  // more than a block of the kernel's, and odd

/// Vertices of every kind, a few metres across.
LitSurface scattered() {
  std::mt19937 random(11);
  std::uniform_real_distribution<float> signedUnit(-1.0F, 1.0F);
  std::uniform_real_distribution<float> unit(0.0F, 1.0F);
  LitSurface object;
  for (std::size_t i = 0; i < kVertices; ++i) {
    Vertex vertex;
    vertex.position = 3.0F * Vec3(signedUnit(random), signedUnit(random), signedUnit(random));
    vertex.normal = glm::normalize(Vec3(signedUnit(random), signedUnit(random), 0.1F + unit(random)));
    vertex.albedo = Vec3(unit(random), unit(random), unit(random));
    vertex.emission = i % 4 == 0 ? unit(random) : 0.0F;
    vertex.tint = i % 3 == 0 ? unit(random) : 0.0F;
    object.surface.vertices.push_back(vertex);
    object.light.push_back({unit(random), unit(random), unit(random), unit(random)});
  }
  return object;
}

BoneLight someLight(bool baked) {
  BoneLight light;
  light.metre = 1.3F;
  light.eye = {-9.0F, -6.0F, 12.0F};  // looks towards the sun
  light.sun = glm::normalize(Vec3(0.5F, 0.4F, -0.6F));
  light.sunColour = {1.8F, 1.3F, 0.8F};
  light.sunShare = 0.7F;
  light.baked = baked;
  light.up = glm::normalize(Vec3(0.1F, 1.0F, 0.2F));
  light.towardsGlow = glm::normalize(Vec3(1.0F, 0.1F, -0.4F));
  light.ambient = {0.2F, 0.25F, 0.3F};
  light.slope = {0.05F, 0.08F, 0.1F};
  light.glow = {0.3F, 0.2F, 0.1F};
  light.lampCount = 2;
  light.lampPosition[0] = {1.0F, 2.0F, 1.0F};
  light.lampPosition[1] = {-2.0F, 0.5F, 3.0F};
  light.lampColour[0] = {2.0F, 1.2F, 0.5F};
  light.lampColour[1] = {0.4F, 0.6F, 1.0F};
  light.clearing = -0.03F;
  light.haze = {0.5F, 0.55F, 0.6F};
  light.hazeGlow = {0.4F, 0.3F, 0.1F};
  light.tintChange = {0.5F, -0.4F, 1.0F};
  light.gloss = baked ? 0.8F : 0.0F;
  return light;
}

/// RGB and A of one vertex, before they are rounded.
glm::dvec4 plainLight(const Vertex& vertex, const world::Vec4& seen, const BoneLight& light) {
  const Vec3d position(vertex.position);
  const Vec3d normal(vertex.normal);
  Vec3d lit(seen.y, seen.z, seen.w);
  if (!light.baked) {
    const double near = 0.5 + 0.5 * glm::dot(normal, Vec3d(light.towardsGlow));
    lit *=
        Vec3d(light.ambient) + Vec3d(light.slope) * glm::dot(normal, Vec3d(light.up)) + Vec3d(light.glow) * near * near;
  }
  for (std::size_t i = 0; i < static_cast<std::size_t>(light.lampCount); ++i) {
    const Vec3d way = Vec3d(light.lampPosition[i]) - position;
    const double cosine = glm::dot(normal, glm::normalize(way));
    const double metres = glm::length(way) * static_cast<double>(light.metre);
    lit += Vec3d(light.lampColour[i]) * (std::max(0.0, (cosine + 0.15) / 1.15) / (metres * metres + 0.02));
  }
  const double cosine = glm::dot(normal, Vec3d(light.sun));
  const double sunSeen = static_cast<double>(seen.x * light.sunShare);
  const Vec3d indirect = lit;
  lit += Vec3d(light.sunColour) * std::max(0.0, cosine) * sunSeen;
  const Vec3d way = position - Vec3d(light.eye);
  const double cleared = std::exp(static_cast<double>(light.clearing) * glm::length(way));
  const double sunwards = std::max(0.0, glm::dot(glm::normalize(way), Vec3d(light.sun)));
  const Vec3d air =
      Vec3d(light.haze) + Vec3d(light.hazeGlow) * (0.36 * std::pow(sunwards, 4.0) + 0.30 * std::pow(sunwards, 16.0));
  const Vec3d shown(vertex.emission);
  const Vec3d paint = Vec3d(vertex.albedo) * (1.0 + Vec3d(light.tintChange) * static_cast<double>(vertex.tint));
  // In the usual form: a GGX lobe times visibility and Fresnel's term, of roughness 0.5 and reflectance 0.04.
  const Vec3d toEye = -glm::normalize(way);
  const Vec3d half =
      (toEye + Vec3d(light.sun)) / std::sqrt(glm::dot(toEye + Vec3d(light.sun), toEye + Vec3d(light.sun)) + 1e-3);
  const double normalToHalf = std::max(glm::dot(normal, half), 0.0);
  const double sunToHalf = std::sqrt((2.0 + 2.0 * glm::dot(toEye, Vec3d(light.sun)) + 1e-3) / 4.0);
  const double lobe = 0.0625 / std::pow(normalToHalf * normalToHalf * (0.0625 - 1.0) + 1.0, 2.0);
  const double sunShare = lobe * 0.04 / (4.0 * sunToHalf * sunToHalf);
  const double skyShare = 0.03 + 0.27 * std::pow(1.0 - std::max(glm::dot(normal, toEye), 0.0), 5.0);
  const Vec3d mirrored = static_cast<double>(light.gloss) *
                         (sunShare * Vec3d(light.sunColour) * std::max(0.0, cosine) * sunSeen + skyShare * indirect);
  const Vec3d radiance = (paint * (lit + shown) + mirrored) * cleared + air * (1.0 - cleared);
  const double relief = sunSeen * std::min(std::max(4.0 * cosine + 0.5, 0.0), 1.0) * cleared *
                        glm::dot(Vec3d(light.sunColour), Vec3d(1.0)) /
                        (glm::dot(lit, Vec3d(1.0)) + static_cast<double>(vertex.emission));
  const auto display = [](double linear) { return 255.0 * world::toDisplay(static_cast<float>(linear)); };
  return {display(radiance.r), display(radiance.g), display(radiance.b),
          255.0 * std::min(relief / static_cast<double>(kMaxRelief), 1.0)};
}

/// Fails if a target leaves a term or a vertex out. Rounding is half a step, the display curve 0.3 and more.
TEST(VertexLightKernels, MatchesTheFormulaOnEveryTarget) {
  const LitSurface object = scattered();
  const VertexArrays arrays(object);
  tests::onEachTarget([&] {
    for (const bool baked : {true, false}) {
      const BoneLight light = someLight(baked);
      for (const auto& [begin, end] : {std::pair<std::size_t, std::size_t>{0, kVertices}, {5, 6}, {17, 50}}) {
        std::vector<std::uint32_t> out(kVertices + 1, 0x12345678U);
        lightRun(arrays, begin, end, light, out.data());
        for (std::size_t i = 0; i < out.size(); ++i) {
          if (i < begin || i >= end) {
            ASSERT_EQ(out[i], 0x12345678U) << i;
            continue;
          }
          const glm::dvec4 expected = plainLight(object.surface.vertices[i], object.light[i], light);
          for (int channel = 0; channel < 4; ++channel) {
            ASSERT_NEAR(out[i] >> (8 * channel) & 0xFFU, expected[channel], 1.1)
                << "vertex " << i << ", channel " << channel;
          }
        }
      }
    }
  });
}

}  // namespace
}  // namespace grove::raster
