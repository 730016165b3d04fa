#pragma once

#include <atomic>
#include <cstdint>
#include <span>
#include <vector>

#include "pipeline/memory_ledger.h"
#include "world/geometry.h"
#include "world/ground/hills.h"
#include "world/rays/ray_scene.h"

namespace grove::objects::figure {

/// Where trees and stones leave the sun to the ground. Across-user: each place is looked at once, when a shadow first
/// falls there. Any thread.
class GroundSun {
 public:
  /// For the square of this radius around the origin, on ground that the hills make; `rays` and `hills` outlive it.
  GroundSun(float radius, world::Vec3 sun, std::span<const world::Hill> hills, const world::RayScene& rays,
            pipeline::MemoryLedger& memory);

  /// Share of the sun at a place on the ground, 0..1, interpolated. Beyond the square, that at its edge.
  [[nodiscard]] float at(float x, float z) const;

 private:
  [[nodiscard]] float look(int column, int row) const;

  const world::Vec3 sun_;
  const std::span<const world::Hill> hills_;
  const world::RayScene& rays_;
  const int size_;  ///< places along each side
  mutable std::vector<std::atomic<std::uint8_t>> shares_;
  const pipeline::HeldMemory held_;
};

}  // namespace grove::objects::figure
