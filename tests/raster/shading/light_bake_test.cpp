#include "raster/shading/light_bake.h"

#include <gtest/gtest.h>

#include <vector>

namespace grove::raster {
namespace {

using world::Vec2;
using world::Vec3;
using world::Vec4;

/// Light at a point of an object, under an empty sky.
Vec4 lightAt(Vec3 point, Vec3 normal, const world::Transform& transform, std::span<const world::Hill> hills) {
  Surface surface;
  surface.vertices.push_back({.position = point, .normal = normal});
  const world::RayScene nothing{world::Triangles()};
  std::vector<Vec4> light(1);
  bakeLight(surface, transform.matrix(), world::Sky(), {nothing, nullptr, hills}, 0, light);
  return light.front();
}

void expectNear(Vec4 light, Vec4 expected) {
  for (int i = 0; i < 4; ++i) EXPECT_NEAR(light[i], expected[i], 1e-3F) << i;
}

// Fault: a stone on a hill is as bright at its foot as if it hung in the air.
TEST(LightBake, CountsHeightsFromTheGround) {
  const std::vector<world::Hill> hills{{{0.0F, 0.0F}, 200.0F, 1.5F}};
  const Vec3 foot(0.5F, 0.05F, 0.0F);
  const Vec3 side(1.0F, 0.0F, 0.0F);
  const world::Transform raised{{0.0F, 1.5F, 0.0F}};
  const Vec4 expected = lightAt(foot, side, {}, {});
  expectNear(lightAt(foot, side, raised, hills), expected);
  EXPECT_GT(glm::distance(lightAt(foot, side, raised, {}), expected), 0.01F) << "in the air";
}

// Fault: soil on a hillside has the light of level soil, or leans the wrong way.
TEST(LightBake, NormalsLeanWithTheObject) {
  const Vec2 slope(0.8F, -0.3F);
  const world::Transform high{{0.0F, 50.0F, 0.0F}};
  world::Transform leaning = high;
  leaning.slope = slope;
  const Vec4 expected = lightAt(Vec3(0.0F), glm::normalize(Vec3(-slope.x, 1.0F, -slope.y)), high, {});
  expectNear(lightAt(Vec3(0.0F), Vec3(0.0F, 1.0F, 0.0F), leaning, {}), expected);
  EXPECT_GT(glm::distance(lightAt(Vec3(0.0F), Vec3(0.0F, 1.0F, 0.0F), high, {}), expected), 0.01F);
}

}  // namespace
}  // namespace grove::raster
