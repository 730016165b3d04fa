#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "world/object.h"
#include "world/rays/ray_obstacles.h"
#include "world/rays/ray_scene.h"

namespace grove::world {

/// The surfaces that block smoke and light in a world, in world coordinates. Immutable after construction; shared by
/// all instances of the world and any number of threads.
class WorldGeometry {
 public:
  /// `progress`: see RayScene; runs once for each of the two. Keeps the models.
  explicit WorldGeometry(const std::vector<ModelledObject>& objects, const std::function<void(float)>& progress = {});

  /// Surfaces that block smoke.
  [[nodiscard]] const RayScene& solids() const noexcept { return solids_; }

  /// Surfaces that block light.
  [[nodiscard]] std::span<const PlacedTriangles> shades() const noexcept { return shades_; }
  [[nodiscard]] const RayScene& rays() const noexcept { return rays_; }

  /// Both as voxels.
  [[nodiscard]] const VoxelObstacles& obstacles() const noexcept { return obstacles_; }

  /// Memory use, without the models.
  [[nodiscard]] std::size_t bytes() const noexcept { return solids_.bytes() + rays_.bytes(); }

 private:
  const RayScene solids_;
  const std::vector<PlacedTriangles> shades_;
  const RayScene rays_;
  const RayObstacles obstacles_{solids_, rays_};
};

}  // namespace grove::world
