#include <gtest/gtest.h>

#include <cmath>

#include "objects/figure/backend/figure_shape.h"
#include "objects/figure/backend/shadow/shadow_grid.h"

namespace grove::objects::figure {
namespace {

using world::Vec2;

float cross(Vec2 a, Vec2 b) { return a.x * b.y - a.y * b.x; }

/// Whether any of the caster's triangles covers a point.
bool isCovered(const ShadowCaster& caster, std::span<const Vec2> corners, Vec2 point) {
  for (const auto& [a, b, c] : caster.triangles()) {
    const float ab = cross(corners[b] - corners[a], point - corners[a]);
    const float bc = cross(corners[c] - corners[b], point - corners[b]);
    const float ca = cross(corners[a] - corners[c], point - corners[c]);
    if ((ab > 0.0F && bc > 0.0F && ca > 0.0F) || (ab < 0.0F && bc < 0.0F && ca < 0.0F)) return true;
  }
  return false;
}

/// Would catch an edge on the wrong side of what it encloses, and holes where parts of the figure lie over each other.
TEST(Silhouette, CoversWhatTheTrianglesCover) {
  const raster::LitSurface figure = makeFigure(1.0F);
  const ShadowCaster caster(figure.surface);
  const Vec2 low(-0.6F, -0.1F);
  const Vec2 texel = Vec2(1.2F, 2.1F) / Vec2(kShadowColumns, kShadowRows);
  for (const float yaw : {0.0F, 0.7F, 2.9F}) {
    std::vector<Vec2> corners;
    for (const raster::Vertex& vertex : caster.vertices()) {
      const world::Vec3 at = vertex.position;
      corners.emplace_back(std::cos(yaw) * at.x + std::sin(yaw) * at.z, at.y);
    }
    const ShadowGrid grid = silhouette(caster, corners, low, texel);
    float covered = 0.0F;
    int different = 0;
    for (std::size_t y = 0; y < kShadowRows; ++y) {
      for (std::size_t x = 0; x < kShadowColumns; ++x) {
        float expected = 0.0F;
        for (const Vec2 sample : {Vec2(0.25F, 0.25F), Vec2(0.75F, 0.25F), Vec2(0.25F, 0.75F), Vec2(0.75F, 0.75F)}) {
          expected += isCovered(caster, corners, low + (Vec2(x, y) + sample) * texel) ? 0.25F : 0.0F;
        }
        covered += expected;
        if (grid[y][x] != expected) ++different;
      }
    }
    EXPECT_GT(covered, 1500.0F) << yaw;
    EXPECT_LE(different, 4) << yaw << ": samples on an edge";
  }
}

}  // namespace
}  // namespace grove::objects::figure
