#include "objects/lightfield/bake/light/surface_light.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/constants.hpp>

#include "objects/lightfield/bake/models.h"
#include "objects/lightfield/bake/refine.h"
#include "world/sky.h"

namespace grove::bake {
namespace {

using world::Vec3;

/// A model with its light.
struct Lit {
  Lit(const models::Model& source, int lightings, int threads = 2, float edge = 0.1F,
      const std::vector<Vec3>& neighbours = {})
      : model(refined(source, {edge, edge})),
        textures(model.textures.begin(), model.textures.end()),
        rays(model, textures),
        points(chooseLightPoints(model, textures, 0.6F * edge)),
        light(lit(Lightings(world::Sky(), lightings), threads, neighbours)) {}

  /// The light on a side of the vertex that is nearest to a place.
  [[nodiscard]] Vec3 at(Vec3 place, int lighting = 0, bool back = false) const {
    std::size_t nearest = 0;
    for (std::size_t v = 0; v < model.triangles.positions.size(); ++v) {
      if (glm::distance(model.triangles.positions[v], place) <
          glm::distance(model.triangles.positions[nearest], place)) {
        nearest = v;
      }
    }
    const auto values = light.at(points.ofVertex[nearest]);
    const std::size_t i = static_cast<std::size_t>(lighting) * 3 + (back ? light.stride() : 0);
    return {values[i], values[i + 1], values[i + 2]};
  }

  models::Model model;
  std::vector<TextureSampler> textures;
  ModelRays rays;
  LightPoints points;
  SurfaceLight light;

 private:
  [[nodiscard]] SurfaceLight lit(const Lightings& lightings, int threads, const std::vector<Vec3>& neighbours) {
    if (!neighbours.empty()) rays.surround(neighbours);
    return lightSurfaces(model, points, rays, lightings, {threads, 0.003F, !neighbours.empty()}, [](float) {}, {});
  }
};

void expectNear(Vec3 actual, Vec3 expected, float share) {
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(actual[c], expected[c], share * expected[c]) << "channel " << c;
}

/// Level quad of 2 m x 2 m around the origin, facing up.
models::Model floorAt(float height, const models::Material& material) {
  models::Model model;
  addQuad(model, {-1, height, -1}, {0, 0, 2}, {2, 0, 0}, addMaterial(model, material));
  return model;
}

TEST(SurfaceLight, OpenFieldHasWorldLight) {
  const Lit lit(floorAt(0.5F, whiteStone()), 3);
  const Vec3 up(0, 1, 0);
  const Vec3 expected = world::Sky().ambient(up) + world::Sky().sunColour * world::Sky().sun.y;
  for (int k = 0; k < 3; ++k) expectNear(lit.at({0, 0.5F, 0}, k), expected, 0.01F);
}

TEST(SurfaceLight, UprightSurfaceHasItsSun) {
  models::Model model;
  const Vec3 sun = world::Sky().sun;
  const Vec3 level = glm::normalize(Vec3(sun.x, 0, sun.z));
  // High above the meadow, which it would shade.
  addQuad(model, Vec3(0, 9, 0), {0, 1, 0}, glm::cross(level, Vec3(0, 1, 0)), addMaterial(model, whiteStone()));
  const Vec3 normal = model.normals.front();
  const Lit lit(model, 2);
  const float cosine = glm::dot(normal, sun);
  ASSERT_GT(std::abs(cosine), 0.9F);
  const Vec3 sunny = world::Sky().sunColour * std::abs(cosine);
  const Vec3 place = model.triangles.positions.front();
  expectNear(lit.at(place, cosine > 0 ? 0 : 1), world::Sky().ambient(level) + sunny, 0.05F);
  expectNear(lit.at(place, cosine > 0 ? 1 : 0), world::Sky().ambient(-level), 0.05F);
}

TEST(SurfaceLight, AWallThrowsAShadow) {
  models::Model model = floorAt(0.0F, whiteStone());
  const Vec3 sun = world::Sky().sun;
  const Vec3 level = glm::normalize(Vec3(sun.x, 0, sun.z));
  const Vec3 side = glm::cross(Vec3(0, 1, 0), level);
  addQuad(model, 0.2F * level - 2.0F * side, 4.0F * side, {0, 3, 0}, addMaterial(model, whiteStone()));
  const Lit lit(model, 1);
  const Vec3 sunPart = world::Sky().sunColour * sun.y;
  const Vec3 inShade = lit.at(-0.5F * level);
  const Vec3 inSun = lit.at(0.6F * level);
  EXPECT_GT(inSun.r, sunPart.r);
  EXPECT_LT(inShade.r, inSun.r - sunPart.r);
  EXPECT_GT(inShade.b, 0.02F) << "the sky still reaches it";
}

TEST(SurfaceLight, RoofedSurfaceGetsLightFromTheMeadow) {
  models::Model model;
  const std::uint16_t white = addMaterial(model, whiteStone());
  addQuad(model, {-1, 1, -1}, {2, 0, 0}, {0, 0, 2}, white);
  const Lit lit(model, 1);
  const Vec3 below = lit.at({0, 1, 0});
  expectNear(below, Lightings(world::Sky(), 1).meadowRadiance(), 0.6F);
  EXPECT_LT(below.r, Lightings(world::Sky(), 1).meadowRadiance().r) << "the roof shades the meadow";
}

/// Fails if a tile is lit as if tiles stood on all sides of it: where a group of tiles ends, its sides would be black.
TEST(SurfaceLight, TileSidesAreLitAsGroupEdges) {
  models::Model block;
  const std::uint16_t dark = addMaterial(block, {.name = "earth", .albedo = Vec3(0.1F), .solid = true});
  addQuad(block, {0.9F, 0, -4}, {0, 1, 0}, {0, 0, 8}, dark);
  addQuad(block, {-0.9F, 0, -4}, {0, 0, 8}, {0, 1, 0}, dark);
  addQuad(block, {-0.9F, 1, -4}, {0, 0, 8}, {1.8F, 0, 0}, dark);
  const Lit alone(block, 1, 2, 0.1F, {{1000, 0, 0}});
  const Lit tile(block, 1, 2, 0.1F, {{2, 0, 0}, {-2, 0, 0}});
  for (const Vec3 place : {Vec3(-0.9F, 0.3F, 0), Vec3(0.9F, 0.3F, 0), Vec3(0, 1, 0)}) {
    expectNear(tile.at(place), alone.at(place), 0.05F);
  }
}

TEST(SurfaceLight, LeavesTransmitSun) {
  models::Model model;
  const Vec3 sun = world::Sky().sun;
  const models::Material leaf{.name = "leaf", .albedo = Vec3(0.2F), .transmittance = Vec3(0.3F)};
  const Vec3 side = glm::normalize(glm::cross(sun, Vec3(0, 1, 0)));
  addQuad(model, Vec3(0, 2, 0), 0.1F * side, 0.1F * glm::cross(side, sun), addMaterial(model, leaf));
  const Lit lit(model, 1);
  ASSERT_LT(glm::dot(lit.model.normals.front(), sun), -0.99F) << "its front looks away from the sun";
  const Vec3 front = lit.at({0, 2, 0}, 0, false);
  const Vec3 back = lit.at({0, 2, 0}, 0, true);
  EXPECT_LT(front.r, 0.6F);
  EXPECT_GT(back.r, world::Sky().sunColour.r);
}

TEST(SurfaceLight, TextureHolesTransmitSun) {
  for (const std::uint32_t texel : {0xFFFFFFFFU, 0x00FFFFFFU}) {
    models::Model model = floorAt(0.0F, whiteStone());
    model.textures.push_back({1, 1, {texel}});
    const std::uint16_t mask =
        addMaterial(model, {.name = "mask", .albedo = Vec3(0.5F), .texture = 0, .alphaCutoff = 0.5F});
    addQuad(model, {-20, 0.5F, -20}, {40, 0, 0}, {0, 0, 40}, mask);
    const Lit lit(model, 1, 2, 1.0F);
    const float open = world::Sky().ambient({0, 1, 0}).r + world::Sky().sunColour.r * world::Sky().sun.y;
    if (texel == 0x00FFFFFFU) {
      EXPECT_NEAR(lit.at({0, 0, 0}).r, open, 0.01F * open);
    } else {
      EXPECT_LT(lit.at({0, 0, 0}).r, 0.2F * open);
    }
  }
}

TEST(SurfaceLight, LightingFollowsTheTurnedModel) {
  constexpr int kLightings = 4;
  const models::Model model = crookedTree();
  const Lit all(model, kLightings);
  for (int k = 1; k < kLightings; ++k) {
    // Turning the model back by k steps brings sun k to where sun 0 is.
    const float angle = -glm::two_pi<float>() * static_cast<float>(k) / kLightings;
    const glm::mat3 turn(glm::rotate(world::Mat4(1.0F), angle, Vec3(0, 1, 0)));
    models::Model turned = model;
    for (Vec3& p : turned.triangles.positions) p = turn * p;
    for (Vec3& n : turned.normals) n = turn * n;
    const Lit one(turned, 1);
    float difference = 0.0F;
    float sum = 0.0F;
    for (std::size_t v = 0; v < model.triangles.positions.size(); ++v) {
      for (const bool back : {false, true}) {
        const Vec3 a = all.at(model.triangles.positions[v], k, back);
        const Vec3 b = one.at(turned.triangles.positions[v], 0, back);
        difference += glm::length(a - b);
        sum += glm::length(a);
      }
    }
    EXPECT_LT(difference, 0.06F * sum) << "lighting " << k;
    EXPECT_GT(sum, 0.0F);
  }
}

TEST(SurfaceLight, ThreadsDoNotChangeIt) {
  const Lit one(crookedTree(), 2, 1);
  const Lit three(crookedTree(), 2, 3);
  for (std::size_t i = 0; i < one.points.points.size(); ++i) {
    EXPECT_TRUE(std::ranges::equal(one.light.at(i), three.light.at(i))) << i;
  }
}

TEST(LightPoints, ASmallLeafHasOne) {
  models::Model model;
  addQuad(model, {0, 1, 0}, {0.02F, 0, 0}, {0, 0.01F, 0.02F}, addMaterial(model, {.name = "leaf"}));
  addQuad(model, {0, 1, 0.001F}, {0.02F, 0, 0}, {0, 0.01F, 0.02F}, 0);
  const LightPoints points = chooseLightPoints(model, {}, 0.1F);
  ASSERT_EQ(points.points.size(), 2U) << "one for each leaf, though they are near each other";
  EXPECT_EQ(points.ofVertex[0], points.ofVertex[2]);
  EXPECT_NE(points.ofVertex[0], points.ofVertex[4]);
}

TEST(LightPoints, LeavesAndWoodDoNotShareAPoint) {
  models::Model model;
  const std::uint16_t leaf = addMaterial(model, {.name = "leaf"});
  const std::uint16_t wood = addMaterial(model, {.name = "wood", .solid = true});
  addQuad(model, {0, 1, 0}, {0.02F, 0, 0}, {0, 0, 0.02F}, leaf);
  addQuad(model, {0, 1.001F, 0}, {0.02F, 0, 0}, {0, 0, 0.02F}, leaf);
  addQuad(model, {0, 1.002F, 0}, {0.02F, 0, 0}, {0, 0, 0.02F}, wood);
  addQuad(model, {0.5F, 1, 0.5F}, {0.02F, 0, 0}, {0, 0, 0.02F}, leaf);
  const LightPoints points = chooseLightPoints(model, {}, 0.1F, PointsOf::kCell);
  ASSERT_EQ(points.points.size(), 3U);
  EXPECT_EQ(points.ofVertex[0], points.ofVertex[4]) << "two leaves";
  EXPECT_NE(points.ofVertex[0], points.ofVertex[8]) << "a leaf and wood";
  EXPECT_NE(points.ofVertex[0], points.ofVertex[12]) << "leaves far apart";
}

TEST(Refine, KeepsTheSurfaceAndShortensEdges) {
  const models::Model model = refined(floorAt(0.0F, whiteStone()), {0.3F, 0.3F});
  float area = 0.0F;
  for (const auto& [a, b, c] : model.triangles.indices) {
    const auto& p = model.triangles.positions;
    for (const auto [from, to] : {std::array{a, b}, {b, c}, {c, a}}) EXPECT_LE(glm::distance(p[from], p[to]), 0.3F);
    const Vec3 cross = glm::cross(p[b] - p[a], p[c] - p[a]);
    EXPECT_GT(cross.y, 0.0F);
    area += 0.5F * cross.y;
  }
  EXPECT_NEAR(area, 4.0F, 1.0e-4F);
  EXPECT_EQ(model.materialOf.size(), model.triangles.indices.size());
}

}  // namespace
}  // namespace grove::bake
