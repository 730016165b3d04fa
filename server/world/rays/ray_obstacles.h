#pragma once

#include "world/rays/voxelizer.h"
#include "world/voxel_obstacles.h"

namespace grove::world {

/// Obstacles computed from surfaces by tracing rays, which takes up to tenths of a second. Any thread.
class RayObstacles final : public VoxelObstacles {
 public:
  /// Surfaces that block smoke, and surfaces that block light. Both outlive it.
  RayObstacles(const RayScene& solids, const RayScene& shades) : solids_(solids), shades_(shades) {}

  [[nodiscard]] std::vector<std::uint8_t> solidCells(const Cube& cube) const override {
    return voxelize(solids_, cube);
  }
  [[nodiscard]] std::vector<std::uint8_t> sunlitCells(const Cube& cube, Vec3 towardsSun) const override {
    return sunVisibility(shades_, cube, towardsSun);
  }

 private:
  const RayScene& solids_;
  const RayScene& shades_;
};

}  // namespace grove::world
