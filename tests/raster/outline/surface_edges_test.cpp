#include "raster/outline/surface_edges.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "raster/box.h"

namespace grove::raster {
namespace {

/// Fails if an edge is found twice, or with a triangle that does not have it in its direction.
TEST(SurfaceEdges, AClosedSurfaceHasTwoTrianglesAtEachEdge) {
  const std::vector<Triangle> triangles = makeBox({1, 1, 1}, {}).levels.back().triangles;
  const std::vector<SurfaceEdge> edges = edgesOf(triangles);
  EXPECT_EQ(edges.size(), triangles.size() * 3 / 2);
  const auto has = [&](std::uint32_t triangle, std::uint32_t from, std::uint32_t to) {
    const Triangle& corners = triangles[triangle];
    const auto at = static_cast<std::size_t>(std::ranges::find(corners, from) - corners.begin());
    return at < 3 && corners[(at + 1) % 3] == to;
  };
  for (const SurfaceEdge& edge : edges) {
    ASSERT_NE(edge.right, SurfaceEdge::kNone);
    EXPECT_TRUE(has(edge.left, edge.from, edge.to));
    EXPECT_TRUE(has(edge.right, edge.to, edge.from));
  }
}

TEST(SurfaceEdges, AnOpenSurfaceHasARim) {
  const std::vector<SurfaceEdge> edges = edgesOf(std::vector<Triangle>{{0, 1, 2}, {2, 1, 3}});
  EXPECT_EQ(edges.size(), 5U);
  EXPECT_EQ(std::ranges::count(edges, SurfaceEdge::kNone, &SurfaceEdge::right), 4);
}

/// Fails if a file whose surface branches loses an edge: three triangles meet at one.
TEST(SurfaceEdges, ABranchingSurfaceKeepsItsEdges) {
  const std::vector<SurfaceEdge> edges = edgesOf(std::vector<Triangle>{{0, 1, 2}, {1, 0, 3}, {1, 0, 4}});
  EXPECT_EQ(edges.size(), 8U);
  EXPECT_TRUE(edgesOf({}).empty());
}

}  // namespace
}  // namespace grove::raster
