#include "objects/lightfield/backend/surroundings/rims.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "each_target.h"
#include "models/plants/plants.h"
#include "objects/lightfield/common/object_view.h"
#include "world/camera.h"

namespace grove::objects::lightfield {
namespace {

using world::Vec2;
using world::Vec3;
using world::Vec4;

constexpr std::uint32_t kGreen = 0xFF20A040U;
constexpr float kSpacing = std::numbers::sqrt3_v<float> * models::kTileRadius;

world::Object tileAt(Vec3 position, float yawDegrees) {
  world::Object tile;
  tile.transform.position = position;
  tile.transform.yaw = glm::radians(yawDegrees);
  return tile;
}

/// A tile, and a neighbour across the edge whose normal is z.
std::vector<world::Object> pair(float yawDegrees = 0.0F) {
  return {tileAt({5, 0, -3}, 0), tileAt({5, 0, -3 + kSpacing}, yawDegrees)};
}

/// The phases of a tile's waves at a point of the world.
std::vector<float> phasesAt(const world::Object& tile, const Rims& rims, Vec3 point) {
  const Vec3 own(glm::inverse(tile.transform.matrix()) * Vec4(point, 1.0F));
  std::vector<float> phases;
  for (const Rims::Wave& wave : rims.waves) phases.push_back(glm::dot(wave.vector, Vec2(own.x, own.z)) + wave.offset);
  return phases;
}

/// Fails if a neighbour is not found for one rotation of a tile, or objects elsewhere are taken for neighbours.
TEST(Rims, AreWhereNoNeighbourIs) {
  for (const float yaw : {0.0F, 60.0F, 180.0F, 300.0F}) {
    std::vector<world::Object> objects = pair(yaw);
    objects.push_back(tileAt({5, 0, -3 + 0.5F * kSpacing}, 0));
    for (const world::Object& tile : std::span(objects).first(2)) EXPECT_EQ(rimsOf(tile, objects).edges.size(), 5U);
    objects[1].type = 1;
    EXPECT_EQ(rimsOf(objects[0], objects).edges.size(), 6U) << "an object of another type is no neighbour";
  }
  const std::vector<world::Object> objects = pair();
  for (const Rims::Edge& edge : rimsOf(objects[0], objects).edges) EXPECT_LT(edge.middle.y, 0.9F * kSpacing / 2.0F);
}

/// Fails if a rim has a step where two tiles meet.
TEST(Rims, ContinueOnTheNeighbour) {
  const std::vector<world::Object> objects = pair(120.0F);
  const Vec3 point(5.6F, 0.0F, -3.0F + 0.5F * kSpacing);
  const auto here = phasesAt(objects[0], rimsOf(objects[0], objects), point);
  const auto there = phasesAt(objects[1], rimsOf(objects[1], objects), point);
  for (std::size_t i = 0; i < here.size(); ++i) EXPECT_NEAR(here[i], there[i], 1.0e-4F) << i;
}

/// Fails if plants reach a rim, are missing at a neighbour's edge or amid the tile, or what is removed keeps a depth.
TEST(Rims, PlantsEndBeforeThem) {
  // From above: a pixel is 2.5 cm wide, and all plants are 0.2 m high.
  constexpr int kSize = 160;
  constexpr float kPixel = 0.025F;
  ObjectCamera camera;
  camera.eye = {0, 10, 0};
  camera.corner = {-0.5F * kSize * kPixel / 9.8F, -1, -0.5F * kSize * kPixel / 9.8F};
  camera.perColumn = {kPixel / 9.8F, 0, 0};
  camera.perRow = {0, 0, kPixel / 9.8F};
  raster::ImagePool pool;
  const std::vector<world::Object> objects = pair();
  const Rims rims = rimsOf(objects[0], objects);
  tests::onEachTarget([&] {
    const auto image = pool.acquire({0, 0, kSize, kSize});
    std::ranges::fill(image->colour, kGreen);
    std::ranges::fill(image->depth, 9.8F);
    thinRims(rims, camera, *image);
    const auto at = [&](float x, float z) {
      const auto index = [&](float metres) { return static_cast<int>(metres / kPixel) + kSize / 2; };
      const std::uint32_t colour = image->colourRow(index(z))[index(x)];
      EXPECT_EQ(image->depthRow(index(z))[index(x)] == world::kInfiniteDepth, colour == 0U) << x << ", " << z;
      return colour;
    };
    for (const float x : {-0.2F, -0.1F, 0.0F, 0.2F}) {
      EXPECT_EQ(at(x, 1.68F), kGreen) << "the neighbour continues here";
      EXPECT_EQ(at(x, -1.68F), 0U);
      EXPECT_EQ(at(0.5F * x, 0.4F * x), kGreen);
    }
    // The line where plants end is not straight.
    float least = 10.0F;
    float most = 0.0F;
    for (int i = -8; i < 8; ++i) {
      const float x = 0.1F * static_cast<float>(i);
      float end = -1.7F;
      while (at(x, end) == 0U) end += kPixel;
      least = std::min(least, -end);
      most = std::max(most, -end);
    }
    EXPECT_GT(most - least, 0.1F);
  });
}

}  // namespace
}  // namespace grove::objects::lightfield
