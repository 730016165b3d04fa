#include <cmath>
#include <cstdint>

#include "objects/herd/frontend/deer_parts.h"

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
/// Metres by which the deer differs without them, as far as one looks: their size is that of a few pixels then.
constexpr float kWithoutSpots = 0.022F;

/// Irregular, the same each time: -1..1.
float shift(int number) {
  const float wave = std::sin(12.9898F * static_cast<float>(number)) * 43758.5453F;
  return 2.0F * (wave - std::floor(wave)) - 1.0F;
}

/// Adds a hexagon that lies on the skin.
void addSpot(Surface& spots, const Build& build, float z, float angle, float radius) {
  const Vertex middle = skinAt(build, z, angle);
  const Vec3 along = glm::normalize(Vec3(0, 0, 1) - middle.normal.z * middle.normal);
  const Vec3 across = glm::cross(middle.normal, along);
  const auto first = static_cast<std::uint32_t>(spots.vertices.size());
  Vertex centre = middle;
  centre.position += kSpotLift * middle.normal;
  centre.albedo = glm::mix(kChestnut, kWhiteCoat, build.spots);
  spots.vertices.push_back(centre);
  constexpr std::uint32_t kCorners = 6;
  for (std::uint32_t corner = 0; corner < kCorners; ++corner) {
    const float turn = 1.0471976F * static_cast<float>(corner);
    Vertex vertex = centre;
    vertex.position += radius * (1.25F * std::cos(turn) * along + std::sin(turn) * across);
    vertex.albedo = glm::mix(kChestnut, kWhiteCoat, kSpotEdge * build.spots);
    spots.vertices.push_back(vertex);
    spots.levels.back().triangles.push_back({first, first + 1 + corner, first + 1 + (corner + 1) % kCorners});
  }
}

}  // namespace

Surface makeSpots(const Build& build, bool isChest) {
  Surface spots;
  spots.levels = {{{}, kWithoutSpots, 0}, {}};
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
  spots.levels.back().vertexCount = spots.vertices.size();
  return spots;
}

}  // namespace grove::objects::herd
