#include <cmath>
#include <cstdint>

#include "objects/herd/frontend/body/deer_parts.h"

namespace grove::objects::herd {
namespace {

using raster::Surface;
using raster::Vertex;
using world::Vec3;

// White spots, in rows along the trunk.
constexpr int kSpotRows = 5;
constexpr int kSpotsOfRow = 9;
constexpr float kSpotRadius = 0.019F;
/// Where the shoulder, which would cut spots in two, ends.
constexpr float kShoulderEnd = -0.2F;
constexpr float kSpotLift = 0.004F;
/// How white a spot's edge is, relative to its middle.
constexpr float kSpotEdge = 0.28F;
/// Error of the level without spots, metres: where it is chosen, a spot covers a few pixels.
constexpr float kWithoutSpots = 0.022F;
/// The same with spots of two triangles, which are as bright as those of six, and nearly as large.
constexpr float kPlainSpots = 0.006F;
constexpr float kPlainShare = 0.56F;
constexpr float kPlainSize = 1.06F;

/// Irregular, the same each time: -1..1.
float shift(int number) {
  const float wave = std::sin(12.9898F * static_cast<float>(number)) * 43758.5453F;
  return 2.0F * (wave - std::floor(wave)) - 1.0F;
}

/// Adds a spot that lies on the skin: a hexagon, and a rectangle for the coarser level.
void addSpot(Surface& spots, const Build& build, float z, float angle, float radius) {
  Vertex middle = skinAt(build, z, angle);
  const Vec3 along = glm::normalize(Vec3(0, 0, 1) - middle.normal.z * middle.normal);
  const Vec3 across = glm::cross(middle.normal, along);
  middle.position += kSpotLift * middle.normal;
  const auto add = [&](Vec3 off, float white) {
    spots.vertices.push_back(middle);
    spots.vertices.back().position += off;
    spots.vertices.back().albedo = glm::mix(kChestnut, kWhiteCoat, white * build.spots);
    return static_cast<std::uint32_t>(spots.vertices.size() - 1);
  };
  const auto onEdge = [&](float turn, float size) {
    return size * radius * (1.25F * std::cos(turn) * along + std::sin(turn) * across);
  };
  constexpr std::uint32_t kCorners = 6;
  constexpr float kTurn = 1.0471976F;
  const std::uint32_t centre = add(Vec3(0.0F), 1.0F);
  for (std::uint32_t corner = 0; corner < kCorners; ++corner) {
    add(onEdge(kTurn * static_cast<float>(corner), 1.0F), kSpotEdge);
    spots.levels.back().triangles.push_back({centre, centre + 1 + corner, centre + 1 + (corner + 1) % kCorners});
  }
  const std::uint32_t first = add(onEdge(0.75F * kTurn, kPlainSize), kPlainShare);
  for (const float corner : {2.25F, 3.75F, 5.25F}) add(onEdge(kTurn * corner, kPlainSize), kPlainShare);
  spots.levels[1].triangles.push_back({first, first + 1, first + 2});
  spots.levels[1].triangles.push_back({first, first + 2, first + 3});
}

}  // namespace

Surface makeSpots(const Build& build, bool isChest) {
  Surface spots;
  spots.marked = true;
  spots.levels = {{{}, kWithoutSpots, 0}, {{}, kPlainSpots, 0}, {}};
  for (int row = 0; row < kSpotRows; ++row) {
    for (int i = 0; i < kSpotsOfRow; ++i) {
      const int number = row * kSpotsOfRow + i;
      const float z =
          glm::mix(-0.34F, 0.38F, (static_cast<float>(i) + 0.5F * static_cast<float>(row % 2)) / kSpotsOfRow) +
          0.018F * shift(number);
      const bool isShoulder = row < 2 && z < kShoulderEnd;
      if (isShoulder || (z < 0.0F) != isChest) continue;
      const float angle = 1.32F + 0.29F * static_cast<float>(row) + 0.07F * shift(number + 100);
      const float radius = kSpotRadius * (1.0F + 0.25F * shift(number + 200));
      addSpot(spots, build, z, angle, radius);
      addSpot(spots, build, z, -angle, radius);
    }
  }
  for (const std::size_t level : {1U, 2U}) spots.levels[level].vertexCount = spots.vertices.size();
  return spots;
}

}  // namespace grove::objects::herd
