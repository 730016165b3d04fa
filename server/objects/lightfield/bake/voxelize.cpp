#include "objects/lightfield/bake/voxelize.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "world/rays/ray_scene.h"

namespace grove::bake {

using objects::lightfield::Voxel;
using objects::lightfield::VoxelGrid;
using world::Vec3;

namespace {

constexpr int kRays = 3;            // per cell edge and axis
constexpr int kMaxCrossings = 512;  // per ray
constexpr float kWood = 0.3F;       // share of a cell's volume
constexpr float kLeaves = 0.1F;     // area relative to a cell's face

std::size_t cellIndex(const VoxelGrid& grid, const std::array<int, 3>& at) {
  return (static_cast<std::size_t>(at[2]) * static_cast<std::size_t>(grid.height) + static_cast<std::size_t>(at[1])) *
             static_cast<std::size_t>(grid.width) +
         static_cast<std::size_t>(at[0]);
}

std::size_t cellCount(const VoxelGrid& grid) {
  return static_cast<std::size_t>(grid.width) * static_cast<std::size_t>(grid.height) *
         static_cast<std::size_t>(grid.depth);
}

struct Span {
  float begin;
  float end;
};

/// The spans of a ray inside bodies, or nothing if it never leaves one of them.
std::optional<std::vector<Span>> insideAlong(const world::RayScene& bodies, Vec3 origin, Vec3 direction) {
  std::vector<Span> spans;
  int winding = 0;
  float near = 0.0F;
  float entered = 0.0F;
  for (int i = 0; i < kMaxCrossings; ++i) {
    const auto hit = bodies.intersect(origin, direction, near);
    if (!hit) return winding == 0 ? std::optional(std::move(spans)) : std::nullopt;
    const int turn = glm::dot(hit->normal, direction) < 0.0F ? 1 : -1;
    if (winding == 0) entered = hit->distance;
    winding += turn;
    if (winding == 0) spans.push_back({entered, hit->distance});
    near = std::nextafter(hit->distance, 1.0e30F) + 1.0e-6F;
  }
  return std::nullopt;
}

/// Adds the share of each cell inside bodies along rays of one axis, and the number of rays per cell.
void fillAlong(const world::RayScene& bodies, const VoxelGrid& grid, int axis, std::vector<float>& filled,
               std::vector<float>& rays) {
  const std::array<int, 3> counts{grid.width, grid.height, grid.depth};
  const auto a = static_cast<std::size_t>(axis);
  const std::size_t s = (a + 1) % 3;
  const std::size_t t = (a + 2) % 3;
  const auto axisOf = [](std::size_t which) { return static_cast<int>(which); };
  constexpr float kBefore = 1.0F;  // cells, so that rays start outside
  for (int j = 0; j < counts[t] * kRays; ++j) {
    for (int i = 0; i < counts[s] * kRays; ++i) {
      Vec3 origin = grid.low;
      // Odd offsets from the middle avoid edges that triangles share.
      origin[axisOf(s)] += (static_cast<float>(i) + 0.5013F) / static_cast<float>(kRays) * grid.cell;
      origin[axisOf(t)] += (static_cast<float>(j) + 0.4979F) / static_cast<float>(kRays) * grid.cell;
      origin[axis] -= kBefore * grid.cell;
      Vec3 direction(0.0F);
      direction[axis] = 1.0F;
      const auto spans = insideAlong(bodies, origin, direction);
      if (!spans) continue;
      std::array<int, 3> at{};
      at[s] = i / kRays;
      at[t] = j / kRays;
      for (at[a] = 0; at[a] < counts[a]; ++at[a]) rays[cellIndex(grid, at)] += 1.0F;
      for (const Span& span : *spans) {
        const float begin = std::max(span.begin / grid.cell - kBefore, 0.0F);
        const float end = std::min(span.end / grid.cell - kBefore, static_cast<float>(counts[a]));
        for (at[a] = static_cast<int>(begin); at[a] < counts[a] && static_cast<float>(at[a]) < end; ++at[a]) {
          const auto cell = static_cast<float>(at[a]);
          filled[cellIndex(grid, at)] += std::min(end, cell + 1.0F) - std::max(begin, cell);
        }
      }
    }
  }
}

/// Adds a triangle's area to its cells, in pieces smaller than half a cell.
void addArea(const VoxelGrid& grid, Vec3 a, Vec3 b, Vec3 c, std::vector<float>& areas) {
  const float longest = std::max({glm::length(b - a), glm::length(c - b), glm::length(a - c)});
  const int parts = std::clamp(static_cast<int>(std::ceil(2.0F * longest / grid.cell)), 1, 4096);
  const float area =
      0.5F * glm::length(glm::cross(b - a, c - a)) / (static_cast<float>(parts) * static_cast<float>(parts));
  const Vec3 across = (b - a) / static_cast<float>(parts);
  const Vec3 along = (c - a) / static_cast<float>(parts);
  for (int row = 0; row < parts; ++row) {
    for (int i = 0; i < 2 * (parts - row) - 1; ++i) {
      // Pieces alternate between upright and inverted triangles.
      const int pair = i / 2;
      const float inset = i % 2 == 0 ? 1.0F / 3.0F : 2.0F / 3.0F;
      const Vec3 middle = a + across * (static_cast<float>(pair) + inset) + along * (static_cast<float>(row) + inset);
      const Vec3 place = (middle - grid.low) / grid.cell;
      const std::array<int, 3> at{std::clamp(static_cast<int>(place.x), 0, grid.width - 1),
                                  std::clamp(static_cast<int>(place.y), 0, grid.height - 1),
                                  std::clamp(static_cast<int>(place.z), 0, grid.depth - 1)};
      areas[cellIndex(grid, at)] += area;
    }
  }
}

}  // namespace

Voxels voxelize(const models::Model& model, int longest) {
  const world::Bounds bounds = model.triangles.bounds();
  const Vec3 size = bounds.size();
  Voxels result;
  VoxelGrid& grid = result.grid;
  grid.cell = std::max({size.x, size.y, size.z, 1.0e-3F}) / static_cast<float>(longest);
  grid.low = bounds.low;
  const auto cells = [&](float edge) {
    return std::clamp(static_cast<int>(std::ceil(edge / grid.cell - 1.0e-3F)), 1, longest);
  };
  grid.width = cells(size.x);
  grid.height = cells(size.y);
  grid.depth = cells(size.z);

  const std::size_t count = cellCount(grid);
  std::vector<float> areas(count, 0.0F);
  world::Triangles solids;
  solids.positions = model.triangles.positions;
  for (std::size_t i = 0; i < model.triangles.indices.size(); ++i) {
    const auto& [a, b, c] = model.triangles.indices[i];
    if (model.materials[model.materialOf[i]].solid) {
      solids.indices.push_back({a, b, c});
    } else {
      const std::vector<Vec3>& p = model.triangles.positions;
      addArea(grid, p[a], p[b], p[c], areas);
    }
  }
  std::vector<float> filled(count, 0.0F);
  std::vector<float> rays(count, 0.0F);
  if (!solids.indices.empty()) {
    const world::RayScene bodies(solids);
    for (int axis = 0; axis < 3; ++axis) fillAlong(bodies, grid, axis, filled, rays);
  }
  result.cells.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    const Voxel voxel = filled[i] > kWood * rays[i]                  ? Voxel::kWood
                        : areas[i] > kLeaves * grid.cell * grid.cell ? Voxel::kLeaves
                                                                     : Voxel::kEmpty;
    result.cells[i] = static_cast<std::uint8_t>(voxel);
  }
  return result;
}

}  // namespace grove::bake
