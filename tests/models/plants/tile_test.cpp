#include "models/plants/tile.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "models/plants/soil.h"
#include "world/rays/ray_scene.h"

namespace grove::models {
namespace {

using world::Vec2;
using world::Vec3;

constexpr float kTolerance = 1.0e-5F;
constexpr float kApothem = 0.5F * std::numbers::sqrt3_v<float> * kTileRadius;

/// The turn that brings an edge's normal onto +x.
Vec3 intoFrame(Vec3 p, int edge) {
  const double angle = std::numbers::pi / 6.0 + std::numbers::pi / 3.0 * edge;
  const double cosine = std::cos(angle);
  const double sine = std::sin(angle);
  const auto x = static_cast<double>(p.x);
  const auto z = static_cast<double>(p.z);
  return {static_cast<float>(cosine * x + sine * z), p.y, static_cast<float>(cosine * z - sine * x)};
}

struct StripVertex {
  Vec3 position{0.0F};  ///< x: beyond the edge, z: along it from its middle
  Vec3 normal{0.0F};
  Vec3 colour{0.0F};
};

/// What lies in the strip of an edge and beyond it, in the edge's frame, without the corners' halves that belong to the
/// strips beside it.
std::vector<StripVertex> stripOf(const Model& tile, int edge) {
  std::vector<StripVertex> strip;
  for (std::size_t i = 0; i < tile.triangles.positions.size(); ++i) {
    const Vec3 at = intoFrame(tile.triangles.positions[i], edge);
    if (at.x < kApothem - kEdgeStrip + 0.001F || std::abs(at.z) > 0.5F * kTileRadius) continue;
    strip.push_back({at - Vec3(kApothem, 0, 0), intoFrame(tile.normals[i], edge), tile.colours[i]});
  }
  return strip;
}

/// Vertices of one strip without a partner in the other.
std::size_t unmatched(const std::vector<StripVertex>& strip, const std::vector<StripVertex>& other) {
  std::vector<const StripVertex*> byAlong;
  for (const StripVertex& vertex : other) byAlong.push_back(&vertex);
  std::ranges::sort(byAlong, {}, [](const StripVertex* v) { return v->position.z; });
  const auto close = [](Vec3 a, Vec3 b, float tolerance) {
    const Vec3 d = glm::abs(a - b);
    return std::max({d.x, d.y, d.z}) < tolerance;
  };
  return static_cast<std::size_t>(std::ranges::count_if(strip, [&](const StripVertex& vertex) {
    // At the ends of the strip rounding decides who is in it.
    if (std::abs(vertex.position.z) > 0.5F * kTileRadius - kTolerance ||
        vertex.position.x < -kEdgeStrip + 0.001F + kTolerance) {
      return false;
    }
    auto at = std::ranges::lower_bound(byAlong, vertex.position.z - kTolerance, {},
                                       [](const StripVertex* v) { return v->position.z; });
    for (; at != byAlong.end() && (*at)->position.z < vertex.position.z + kTolerance; ++at) {
      // Slivers' normals turn with the last bits of their corners.
      if (close((*at)->position, vertex.position, kTolerance) && close((*at)->colour, vertex.colour, kTolerance) &&
          close((*at)->normal, vertex.normal, 0.01F)) {
        return false;
      }
    }
    return true;
  }));
}

TEST(Tile, EdgesMatchForAllKindsAndSeeds) {
  const std::vector<StripVertex> reference = stripOf(makePlant("meadow", 1, Detail::kSmall), 0);
  ASSERT_GT(reference.size(), 5'000U);
  for (const char* const name : {"meadow", "flowers", "fern"}) {
    const Model tile = makePlant(name, 99, Detail::kSmall);
    for (int edge = 0; edge < 6; ++edge) {
      const std::vector<StripVertex> strip = stripOf(tile, edge);
      EXPECT_EQ(unmatched(strip, reference), 0U) << name << ' ' << edge;
      EXPECT_EQ(unmatched(reference, strip), 0U) << name << ' ' << edge;
    }
  }
}

TEST(Tile, InteriorDiffersByKindAndSeed) {
  const auto inside = [](const Model& tile) {
    std::vector<float> heights;
    for (const Vec3 p : tile.triangles.positions) {
      if (insideTile({p.x, p.z}) > 0.9F) heights.push_back(p.y);
    }
    return heights;
  };
  const auto meadow = inside(makePlant("meadow", 1, Detail::kSmall));
  EXPECT_NE(meadow, inside(makePlant("meadow", 2, Detail::kSmall)));
  EXPECT_NE(meadow, inside(makePlant("fern", 1, Detail::kSmall)));
}

/// Triangles of the soil only, moved and turned by steps of 60 degrees.
world::Triangles soilOf(const Model& tile, Vec2 to, int turns) {
  world::Triangles soil;
  world::Triangles whole;
  whole.positions = tile.triangles.positions;
  for (std::size_t i = 0; i < tile.materialOf.size(); ++i) {
    if (tile.materials[tile.materialOf[i]].name == "soil") whole.indices.push_back(tile.triangles.indices[i]);
  }
  const world::Transform transform{.position = Vec3(to.x, 0, to.y),
                                   .yaw = std::numbers::pi_v<float> / 3.0F * static_cast<float>(turns)};
  soil.append(whole, transform.matrix());
  return soil;
}

TEST(Tile, SoilIsContinuousAcrossEdges) {
  const Model meadow = makePlant("meadow", 1, Detail::kSmall);
  const Model fern = makePlant("fern", 5, Detail::kSmall);
  for (int turns = 0; turns < 6; ++turns) {
    // The neighbour across the edge whose normal is +z.
    const world::RayScene here(soilOf(meadow, Vec2(0.0F), 0));
    const world::RayScene there(soilOf(fern, Vec2(0.0F, 2.0F * kApothem), turns));
    for (float x = -0.99F; x < 1.0F; x += 0.037F) {
      for (float beyond = -0.5F * kSkirt; beyond <= 0.5F * kSkirt; beyond += 0.25F * kSkirt) {
        const Vec3 from(x, 5.0F, kApothem + beyond);
        const auto mine = here.intersect(from, Vec3(0, -1, 0));
        const auto theirs = there.intersect(from, Vec3(0, -1, 0));
        ASSERT_TRUE(mine && theirs) << x << ' ' << beyond;
        EXPECT_NEAR(mine->distance, theirs->distance, kTolerance) << x << ' ' << beyond;
      }
    }
  }
}

TEST(TilingField, RepeatsAcrossTiles) {
  const TilingField field(4, 0.1F, 1.0F);
  const Vec2 place(0.37F, -0.81F);
  const float value = field.at(place);
  const float half = 0.5F;
  const float sine = 0.5F * std::numbers::sqrt3_v<float>;
  EXPECT_NEAR(field.at({half * place.x - sine * place.y, sine * place.x + half * place.y}), value, kTolerance);
  EXPECT_NEAR(field.at(place + Vec2(0.0F, 2.0F * kApothem)), value, 5 * kTolerance);
  EXPECT_NEAR(field.at(place + Vec2(1.5F * kTileRadius, kApothem)), value, 5 * kTolerance);
  float sum = 0.0F;
  float squares = 0.0F;
  constexpr int kSamples = 40;
  for (int i = 0; i < kSamples * kSamples; ++i) {
    const Vec2 step(1.5F * kTileRadius / kSamples, kApothem / kSamples);
    const float v = field.at(Vec2(static_cast<float>(i % kSamples), static_cast<float>(2 * (i / kSamples))) * step);
    sum += v;
    squares += v * v;
  }
  EXPECT_NEAR(sum / (kSamples * kSamples), 0.0F, 0.05F);
  EXPECT_NEAR(std::sqrt(squares / (kSamples * kSamples)), 1.0F, 0.25F);
}

}  // namespace
}  // namespace grove::models
