#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "objects/fluid/backend/solver/grid.h"
#include "pipeline/vector_bytes.h"
#include "world/geometry.h"

namespace grove::objects::fluid {

/// An upright moving body in the fluid's own coordinates (metres from the cube's low corner).
struct Capsule {
  world::Vec3 foot{0.0F};  ///< lowest point of the axis
  float height = 1.8F;     ///< from the lowest to the highest point, metres
  float radius = 0.3F;     ///< metres
  world::Vec3 velocity{0.0F};
};

/// Solid cells and their motion. One thread.
class SolidGrid {
 public:
  SolidGrid(const Layout& layout, const Sides& sides);

  /// `solid` holds one byte per cell, x fastest, without ghosts (cells^3); non-zero is solid. Replaces all static
  /// solids.
  void setStatic(std::span<const std::uint8_t> solid);

  /// Replaces the moving solids. `cellSize` is in metres.
  void setMovers(std::span<const Capsule> movers, float cellSize);

  /// Sets all faces of solids and walls to the solid's velocity, so that nothing flows through.
  void enforce(Velocity& velocity) const;

  /// 1 in air: fluid cells and the ghosts outside open sides; 0 in solids and behind walls.
  [[nodiscard]] const Array<std::uint8_t>& air() const noexcept { return air_; }
  [[nodiscard]] const Layout& layout() const noexcept { return layout_; }
  [[nodiscard]] const Sides& sides() const noexcept { return sides_; }
  [[nodiscard]] int solidCells() const noexcept { return staticCells_ + static_cast<int>(moving_.size()); }

  /// Bounds of the cells that have changed between solid and air since the last call; empty if none.
  [[nodiscard]] CellBox takeChanges() noexcept;

  /// Memory use.
  [[nodiscard]] std::size_t bytes() const noexcept {
    return heldBytes(staticAir_, air_) + pipeline::vectorBytes(wallFaces_[0], wallFaces_[1], wallFaces_[2], moving_);
  }

 private:
  struct MovingCell {
    std::ptrdiff_t index = 0;
    world::Vec3 velocity{0.0F};
  };
  void collectWallFaces();

  const Layout layout_;
  const Sides sides_;
  Array<std::uint8_t> staticAir_;
  Array<std::uint8_t> air_;
  std::array<std::vector<std::int32_t>, 3> wallFaces_;  ///< by axis: faces of static solids and closed sides
  std::vector<MovingCell> moving_;
  CellBox movingBox_;
  CellBox changed_;
  int staticCells_ = 0;
};

}  // namespace grove::objects::fluid
