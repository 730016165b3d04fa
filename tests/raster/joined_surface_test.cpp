#include "raster/joined_surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

namespace grove::raster {
namespace {

using world::Vec3;

Surface ball(float radius) {
  return makeDeformedBox({2, 2, 2}, 3, [=](Vec3 cube) {
    Vertex vertex;
    vertex.position = radius * glm::normalize(cube);
    return vertex;
  });
}

class JoinedSurfaceTest : public testing::Test {
 protected:
  /// A level's triangles of one part.
  [[nodiscard]] std::size_t trianglesOf(std::size_t part, const Level& level) const {
    const std::size_t first = part == 0 ? 0 : parts_[0].vertices.size();
    const std::size_t end = first + parts_[part].vertices.size();
    return static_cast<std::size_t>(std::ranges::count_if(level.triangles, [=](const Triangle& triangle) {
      return std::ranges::all_of(triangle, [=](std::uint32_t corner) { return corner >= first && corner < end; });
    }));
  }

  const std::array<Surface, 2> parts_{ball(1.0F), ball(0.1F)};
  const Surface all_ = joined(parts_);
};

/// Fails if a level costs more than the next finer one, or is worse than the next coarser one.
TEST_F(JoinedSurfaceTest, LevelsGoFromCoarseToFine) {
  ASSERT_GT(all_.levels.size(), 3U);
  EXPECT_FLOAT_EQ(all_.levels.front().error, parts_[0].levels.front().error) << "the worst part decides";
  EXPECT_EQ(all_.levels.back().error, 0.0F);
  for (std::size_t i = 1; i < all_.levels.size(); ++i) {
    EXPECT_LT(all_.levels[i].error, all_.levels[i - 1].error) << i;
    EXPECT_GT(all_.levels[i].triangles.size(), all_.levels[i - 1].triangles.size()) << i;
  }
}

/// Fails if a part that is fine enough follows one that is not.
TEST_F(JoinedSurfaceTest, PartsThatGainLittleStayCoarse) {
  const auto isBigRefined = [&](const Level& level) {
    return trianglesOf(0, level) > parts_[0].levels.front().triangles.size();
  };
  const auto refined = std::ranges::find_if(all_.levels, isBigRefined);
  ASSERT_NE(refined, all_.levels.end());
  EXPECT_EQ(trianglesOf(1, *refined), parts_[1].levels.front().triangles.size());
}

/// Fails if a part is lost, or if triangles join the vertices of different parts.
TEST_F(JoinedSurfaceTest, EveryLevelHasAllParts) {
  ASSERT_EQ(all_.vertices.size(), parts_[0].vertices.size() + parts_[1].vertices.size());
  EXPECT_EQ(all_.vertices.back().position, parts_[1].vertices.back().position);
  for (const Level& level : all_.levels) {
    EXPECT_GE(trianglesOf(0, level), parts_[0].levels.front().triangles.size());
    EXPECT_GE(trianglesOf(1, level), parts_[1].levels.front().triangles.size());
    EXPECT_EQ(trianglesOf(0, level) + trianglesOf(1, level), level.triangles.size());
  }
  EXPECT_EQ(trianglesOf(0, all_.levels.back()), parts_[0].levels.back().triangles.size());
  EXPECT_EQ(trianglesOf(1, all_.levels.back()), parts_[1].levels.back().triangles.size());
}

}  // namespace
}  // namespace grove::raster
