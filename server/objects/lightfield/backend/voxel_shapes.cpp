#include "objects/lightfield/backend/voxel_shapes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace grove::objects::lightfield {
namespace {

using world::Triangles;
using world::Vec3;

constexpr float kChestHeight = 1.0F;  // metres
constexpr float kLeafCard = 0.8F;     // share of a cell's edge: the rest of the light passes

struct Cell {
  int x = 0;
  int y = 0;
  int z = 0;
};

Voxel voxelAt(const VoxelGrid& voxels, Cell at) {
  if (at.x < 0 || at.y < 0 || at.z < 0 || at.x >= voxels.width || at.y >= voxels.height || at.z >= voxels.depth) {
    return Voxel::kEmpty;
  }
  const auto index = (static_cast<std::size_t>(at.z) * voxels.height + at.y) * voxels.width + at.x;
  return static_cast<Voxel>(voxels.cells[index]);
}

template <typename Visit>
void forEachCell(const VoxelGrid& voxels, Voxel kind, const Visit& visit) {
  for (int z = 0; z < voxels.depth; ++z) {
    for (int y = 0; y < voxels.height; ++y) {
      for (int x = 0; x < voxels.width; ++x) {
        if (voxelAt(voxels, {x, y, z}) == kind) visit(Cell{x, y, z});
      }
    }
  }
}

Vec3 centreOf(const VoxelGrid& voxels, Cell at) {
  return voxels.low +
         (Vec3(static_cast<float>(at.x), static_cast<float>(at.y), static_cast<float>(at.z)) + 0.5F) * voxels.cell;
}

/// The parallelogram centre +- a +- b; a x b points to its front.
void addQuad(Triangles& to, Vec3 centre, Vec3 a, Vec3 b) {
  const auto first = static_cast<std::uint32_t>(to.positions.size());
  for (const Vec3 corner : {centre - a - b, centre + a - b, centre + a + b, centre - a + b}) {
    to.positions.push_back(corner);
  }
  to.indices.push_back({first, first + 1, first + 2});
  to.indices.push_back({first, first + 2, first + 3});
}

std::uint32_t hashOf(Cell at) {
  std::uint32_t h = static_cast<std::uint32_t>(at.x) * 73856093U ^ static_cast<std::uint32_t>(at.y) * 19349663U ^
                    static_cast<std::uint32_t>(at.z) * 83492791U;
  h = (h ^ (h >> 15U)) * 2246822519U;
  return h ^ (h >> 13U);
}

Vec3 randomUnit(std::uint32_t hash) {
  const float height = static_cast<float>(hash & 0xFFFFU) / 32767.5F - 1.0F;
  const float around = static_cast<float>(hash >> 16U) * (6.2831853F / 65536.0F);
  const float flat = std::sqrt(std::max(0.0F, 1.0F - height * height));
  return {flat * std::cos(around), height, flat * std::sin(around)};
}

}  // namespace

Triangles woodSurface(const VoxelGrid& voxels) {
  constexpr std::array<Cell, 6> kSides{Cell{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  Triangles surface;
  const float half = 0.5F * voxels.cell;
  forEachCell(voxels, Voxel::kWood, [&](Cell at) {
    for (const Cell& side : kSides) {
      if (voxelAt(voxels, {at.x + side.x, at.y + side.y, at.z + side.z}) == Voxel::kWood) continue;
      const Vec3 out(static_cast<float>(side.x), static_cast<float>(side.y), static_cast<float>(side.z));
      const Vec3 a = side.y != 0 ? Vec3(0, 0, 1) : Vec3(0, 1, 0);
      addQuad(surface, centreOf(voxels, at) + out * half, a * half, glm::cross(out, a) * half);
    }
  });
  return surface;
}

Triangles shadeSurface(const VoxelGrid& voxels) {
  Triangles shade = woodSurface(voxels);
  const float half = 0.5F * kLeafCard * voxels.cell;
  forEachCell(voxels, Voxel::kLeaves, [&](Cell at) {
    const Vec3 normal = randomUnit(hashOf(at));
    const Vec3 helper = std::abs(normal.y) < 0.9F ? Vec3(0, 1, 0) : Vec3(1, 0, 0);
    const Vec3 a = glm::normalize(glm::cross(normal, helper));
    addQuad(shade, centreOf(voxels, at), a * half, glm::cross(normal, a) * half);
  });
  return shade;
}

std::optional<float> trunkRadius(const VoxelGrid& voxels) {
  const int y = static_cast<int>(std::floor((kChestHeight - voxels.low.y) / std::max(voxels.cell, 1.0e-6F)));
  int cells = 0;
  for (int z = 0; z < voxels.depth; ++z) {
    for (int x = 0; x < voxels.width; ++x) cells += voxelAt(voxels, {x, y, z}) == Voxel::kWood ? 1 : 0;
  }
  if (cells == 0) return std::nullopt;
  return voxels.cell * std::sqrt(static_cast<float>(cells) / 3.1415927F);
}

}  // namespace grove::objects::lightfield
