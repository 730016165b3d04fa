#include "objects/ground/backend/clearing_bake.h"

#include <gtest/gtest.h>

#include <cmath>

#include "world/sky.h"

namespace grove::objects::ground {
namespace {

/// An upright box of 1.2 m by 3 m around a point.
world::Triangles pillar(world::Vec3 at) {
  world::Triangles box;
  for (const world::Vec3 corner :
       world::Bounds{at + world::Vec3(-0.6F, 0, -0.6F), at + world::Vec3(0.6F, 3, 0.6F)}.corners()) {
    box.positions.push_back(corner);
  }
  box.indices = {{0, 1, 3}, {0, 3, 2}, {4, 6, 7}, {4, 7, 5}, {0, 4, 5}, {0, 5, 1},
                 {2, 3, 7}, {2, 7, 6}, {0, 2, 6}, {0, 6, 4}, {1, 5, 7}, {1, 7, 3}};
  return box;
}

struct Soil {
  float sun, sky, dry, grass;
};

Soil soilAt(const Clearing& clearing, world::Vec3 point) {
  const auto size = static_cast<float>(clearing.pyramid.size());
  const auto index = [&](float metres) { return static_cast<int>((metres / clearing.metres + 0.5F) * size); };
  const std::uint32_t texel = clearing.pyramid.level(0)[index(point.z) * clearing.pyramid.size() + index(point.x)];
  const auto channel = [&](unsigned shift) { return static_cast<float>((texel >> shift) & 0xFFU) / 255.0F; };
  return {channel(0), channel(8), channel(16), channel(24)};
}

void forEachRow(std::string_view /*label*/, std::size_t rows, const std::function<void(std::size_t)>& work) {
  for (std::size_t row = 0; row < rows; ++row) work(row);
}

class ClearingBake : public testing::Test {
 protected:
  const world::Vec3 stone{6.0F, 0.0F, 2.0F};
  const std::vector<world::PlacedTriangles> solids{{std::make_shared<world::Triangles>(pillar(stone))}};
  const world::RayScene rays{solids};
  const ClearingOptions options{.size = 256, .metres = 40.0F};
  const Clearing clearing = bakeClearing(options, world::Sky().sun, {solids, rays, rays}, forEachRow);
  const world::Vec3 sunward = glm::normalize(world::Sky().sun * world::Vec3(1, 0, 1));
};

TEST_F(ClearingBake, TheShadowFallsAwayFromTheSun) {
  for (const float metres : {2.0F, 4.0F, 6.0F}) {
    EXPECT_LT(soilAt(clearing, stone - sunward * metres).sun, 0.1F) << metres;
    EXPECT_GT(soilAt(clearing, stone + sunward * metres).sun, 0.9F) << metres;
  }
  // Longer than the stone's height over the sun's tangent there is none.
  EXPECT_GT(soilAt(clearing, {-18.0F, 0.0F, 15.0F}).sun, 0.9F);
}

/// Fails if the light of hillsides is that of the plane below: a hill behind a stone shortens its shadow.
TEST_F(ClearingBake, ShadowsOnAHillsideAreShorter) {
  const world::Vec3 away = stone - sunward * 14.0F;
  ClearingOptions hilly = options;
  hilly.hills = {{{away.x, away.z}, 6.0F, 1.5F}};
  const Clearing onHill = bakeClearing(hilly, world::Sky().sun, {solids, rays, rays}, forEachRow);
  float last = 0.0F;
  float lastOnHill = 0.0F;
  for (int step = 10; step < 100; ++step) {
    const float metres = 0.2F * static_cast<float>(step);
    if (soilAt(clearing, stone - sunward * metres).sun < 0.5F) last = metres;
    if (soilAt(onHill, stone - sunward * metres).sun < 0.5F) lastOnHill = metres;
  }
  EXPECT_GT(last, 8.0F);
  EXPECT_LT(lastOnHill, last - 0.8F);
}

TEST_F(ClearingBake, ShadowHasASoftEdge) {
  const world::Vec3 aside(-sunward.z, 0.0F, sunward.x);
  int between = 0;
  for (int step = -60; step <= 60; ++step) {
    const float offset = 0.05F * static_cast<float>(step);
    const float sun = soilAt(clearing, stone - sunward * 9.0F + aside * offset).sun;
    if (sun > 0.1F && sun < 0.9F) ++between;
  }
  EXPECT_GT(between, 2);
}

TEST_F(ClearingBake, StonesOccludeTheSkyAtTheirFeet) {
  const world::Vec3 aside(-sunward.z, 0.0F, sunward.x);
  EXPECT_LT(soilAt(clearing, stone + aside * 1.2F).sky, 0.85F);
  EXPECT_GT(soilAt(clearing, {-10.0F, 0.0F, -10.0F}).sky, 0.99F);
}

TEST_F(ClearingBake, NoGrassGrowsAtTheFire) {
  EXPECT_LT(soilAt(clearing, {0.3F, 0.0F, -0.2F}).grass, 0.02F);
  EXPECT_GT(soilAt(clearing, {-10.0F, 0.0F, -10.0F}).grass, 0.3F);
}

// Fault: ground that nobody comes near has no shadows, or other light than ground nearby.
TEST_F(ClearingBake, LightIsSimilarWhereNobodyComesNear) {
  ClearingOptions coarse = options;
  coarse.detailed = 1.0F;
  const Clearing far = bakeClearing(coarse, world::Sky().sun, {solids, rays, rays}, forEachRow);
  double sun = 0.0;
  double sky = 0.0;
  double grass = 0.0;
  int points = 0;
  for (int column = -30; column <= 30; ++column) {
    for (int row = -30; row <= 30; ++row) {
      const float x = 0.5F * static_cast<float>(column);
      const float z = 0.5F * static_cast<float>(row);
      const Soil fine = soilAt(clearing, {x, 0.0F, z});
      const Soil rough = soilAt(far, {x, 0.0F, z});
      sun += static_cast<double>(std::abs(fine.sun - rough.sun));
      sky += static_cast<double>(std::abs(fine.sky - rough.sky));
      ++points;
      grass += static_cast<double>(std::abs(fine.grass - rough.grass));
    }
  }
  EXPECT_LT(sun / points, 0.02);
  EXPECT_LT(sky / points, 0.02);
  EXPECT_LT(grass / points, 0.02);
  EXPECT_LT(soilAt(far, stone - sunward * 4.0F).sun, 0.1F);
}

/// A square of 4 m, level, around a point of the ground.
world::Triangles roof(world::Vec3 place, float height) {
  world::Triangles leaves;
  for (const world::Vec2 corner : {world::Vec2(-2, -2), world::Vec2(2, -2), world::Vec2(2, 2), world::Vec2(-2, 2)}) {
    leaves.positions.push_back(place + world::Vec3(corner.x, height, corner.y));
  }
  leaves.indices = {{0, 1, 2}, {0, 2, 3}};
  return leaves;
}

/// Bakes with texels as small as the world's. `solid`: whether the surface is no foliage.
Clearing bakedUnder(const world::Triangles& surface, bool solid) {
  const std::vector<world::PlacedTriangles> surfaces{{std::make_shared<world::Triangles>(surface)}};
  const world::RayScene rays(surfaces);
  const world::RayScene nothing{world::Triangles()};
  return bakeClearing({.size = 512, .metres = 40.0F}, world::Sky().sun, {surfaces, rays, solid ? rays : nothing},
                      forEachRow);
}

/// Fails if sunlight passes through the foot of a trunk, which belongs to a light field as low leaves do.
TEST_F(ClearingBake, TrunksAreOpaqueNearTheGround) {
  const world::Vec3 place(-10.0F, 0.0F, -10.0F);
  const Clearing baked = bakedUnder(pillar(place), false);
  EXPECT_LT(soilAt(baked, place - sunward * 1.2F).sun, 0.1F);
}

TEST_F(ClearingBake, LowFoliageLeavesNoBlackGaps) {
  // Leaves close above the ground, around a place that nothing else shades.
  const world::Vec3 place(-10.0F, 0.0F, -10.0F);
  const Clearing baked = bakedUnder(roof(place, 0.12F), false);
  const Soil underLeaves = soilAt(baked, place);
  EXPECT_LT(underLeaves.grass, 0.4F * soilAt(clearing, place).grass) << "its blades would stick through the plants";
  EXPECT_GT(underLeaves.grass, 0.2F * soilAt(clearing, place).grass) << "or bare earth would show beneath their rim";
  EXPECT_GT(underLeaves.sun, 0.3F) << "or gaps between plants would be black";
  const world::Vec3 edge = place + world::Vec3(1.9F, 0.0F, 0.0F);
  EXPECT_GT(soilAt(baked, edge).grass, 0.8F * soilAt(clearing, edge).grass) << "or bare earth would frame the plants";
  const Soil underStone = soilAt(bakedUnder(roof(place, 0.3F), true), place);
  EXPECT_GT(underStone.grass, 0.3F) << "it lends its values to the grass at a stone's foot";
  EXPECT_LT(underStone.sun, 0.1F);
  EXPECT_GT(soilAt(bakedUnder(roof(place, 0.12F), true), place).sun, 0.9F) << "soil of plants, which is lit";
}

// Fault: a dark strip along the edge of a patch of high grass, as if it were a wall.
TEST_F(ClearingBake, LowFoliageCastsALightShadow) {
  const world::Vec3 place(-10.0F, 0.0F, -10.0F);
  const auto sunBehind = [&](float height) {
    const float away = 2.0F + 0.5F * height / std::tan(std::asin(world::Sky().sun.y));
    return soilAt(bakedUnder(roof(place, height), false), place - sunward * away).sun;
  };
  EXPECT_NEAR(sunBehind(0.5F), 0.7F, 0.05F);
  EXPECT_LT(sunBehind(1.5F), 0.1F);
}

// Fault: light is baked for level ground, so that shadows climb hills that rise above them.
TEST_F(ClearingBake, ShadowsEndWhereHillsRiseAboveThem) {
  const world::Vec3 sun = world::Sky().sun;
  const float descent = sun.y / glm::length(world::Vec2(sun.x, sun.z));
  const world::Vec3 place = stone - sunward * ((3.0F - 0.7F) / descent);  // the shadow is 0.7 m high here
  ClearingOptions hilly = options;
  hilly.hills = {{{place.x, place.z}, 3.0F, 1.5F}};
  const Clearing baked = bakeClearing(hilly, sun, {solids, rays, rays}, forEachRow);
  EXPECT_LT(soilAt(clearing, place).sun, 0.1F);
  EXPECT_GT(soilAt(baked, place).sun, 0.9F);
  EXPECT_LT(soilAt(baked, stone - sunward * 2.0F).sun, 0.1F) << "before the hill";
}

// Fault: the ground below plants on a hill lies beneath their soil, and is black.
TEST_F(ClearingBake, SoilOnAHillIsLit) {
  const world::Vec3 place(-10.0F, 0.0F, -10.0F);
  world::Triangles soil = roof(place + world::Vec3(0.0F, 1.2F, 0.0F), 0.12F);
  for (world::Vec3& corner : soil.positions) corner += 4.0F * (corner - place) * world::Vec3(1, 0, 1);
  const std::vector<world::PlacedTriangles> surfaces{{std::make_shared<world::Triangles>(soil)}};
  const world::RayScene surface(surfaces);
  const ClearingOptions hilly{.size = 512, .metres = 40.0F, .hills = {{{place.x, place.z}, 60.0F, 1.2F}}};
  const Clearing baked = bakeClearing(hilly, world::Sky().sun, {surfaces, surface, surface}, forEachRow);
  EXPECT_GT(soilAt(baked, place).sun, 0.9F);
}

}  // namespace
}  // namespace grove::objects::ground
