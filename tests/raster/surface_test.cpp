#include "raster/surface.h"

#include <gtest/gtest.h>

#include <cmath>

namespace grove::raster {
namespace {

using world::Vec3;

constexpr float kFocal = 600.0F;

Surface roundSurface() {
  return makeDeformedBox({3, 3, 3}, 3, [](Vec3 cube) {
    Vertex vertex;
    vertex.position = glm::normalize(cube);
    return vertex;
  });
}

/// Root mean square distance of the middles of a level's edges from the ball.
float sagitta(const Surface& surface, const Level& level) {
  float sum = 0.0F;
  int count = 0;
  for (const auto& [a, b, c] : level.triangles) {
    for (const auto& [from, to] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)}) {
      const float below = 1.0F - glm::length(0.5F * (surface.vertices[from].position + surface.vertices[to].position));
      sum += below * below;
      ++count;
    }
  }
  return std::sqrt(sum / static_cast<float>(count));
}

/// Fails if a level's error is that of another level, or of one halving alone.
TEST(Surface, LevelsKnowTheirErrors) {
  const Surface surface = roundSurface();
  ASSERT_EQ(surface.levels.size(), 4U);
  for (std::size_t i = 0; i < 3; ++i) {
    const float expected = sagitta(surface, surface.levels[i]);
    EXPECT_GT(surface.levels[i].error, 0.99F * expected) << i;
    EXPECT_LT(surface.levels[i].error, 1.05F * expected) << i;
  }
  EXPECT_EQ(surface.levels.back().error, 0.0F);
}

/// Fails if a level is chosen whose outline is more than a pixel off, or a finer one than needed.
TEST(Surface, TheLevelFollowsTheErrorOnTheScreen) {
  const Surface surface = roundSurface();
  EXPECT_EQ(&surface.levelFor(0.5F, kFocal), &surface.levels.back());
  for (std::size_t i = 0; i < 3; ++i) {
    const float aPixelAt = surface.levels[i].error * kFocal;
    EXPECT_EQ(&surface.levelFor(1.1F * aPixelAt, kFocal), &surface.levels[i]);
    EXPECT_EQ(&surface.levelFor(0.9F * aPixelAt, kFocal), &surface.levels[i + 1]);
  }
}

/// Fails if a part that is scaled keeps its error, or if a finer part hides a coarser one.
TEST(Surface, TheCoarsestPartDecides) {
  Surface surface;
  surface.append(roundSurface(), glm::scale(world::Mat4(1.0F), Vec3(2.0F)));
  surface.append(roundSurface(), glm::scale(world::Mat4(1.0F), Vec3(0.5F)));
  EXPECT_FLOAT_EQ(surface.levels.front().error, 2.0F * roundSurface().levels.front().error);
  EXPECT_EQ(surface.levels.back().error, 0.0F);
}

/// Fails if a coarse level of a surface of several parts needs the vertices of fine ones, or if a vertex is mixed up.
TEST(Surface, CoarseLevelsUseTheFirstVertices) {
  Surface surface;
  surface.append(roundSurface(), world::Mat4(1.0F));
  surface.append(roundSurface(), glm::translate(world::Mat4(1.0F), Vec3(3.0F, 0.0F, 0.0F)));
  const Surface before = surface;
  const std::vector<std::uint32_t> order = surface.putCoarseFirst();
  ASSERT_EQ(order.size(), before.vertices.size());
  for (std::size_t level = 0; level < surface.levels.size(); ++level) {
    const Level& sorted = surface.levels[level];
    EXPECT_EQ(sorted.vertexCount, 2 * roundSurface().levels[level].vertexCount) << level;
    ASSERT_EQ(sorted.triangles.size(), before.levels[level].triangles.size());
    for (std::size_t i = 0; i < sorted.triangles.size(); ++i) {
      for (std::size_t corner = 0; corner < 3; ++corner) {
        const std::uint32_t vertex = sorted.triangles[i][corner];
        ASSERT_LT(vertex, sorted.vertexCount);
        ASSERT_EQ(order[vertex], before.levels[level].triangles[i][corner]);
        ASSERT_EQ(surface.vertices[vertex].position, before.vertices[order[vertex]].position);
      }
    }
  }
}

}  // namespace
}  // namespace grove::raster
