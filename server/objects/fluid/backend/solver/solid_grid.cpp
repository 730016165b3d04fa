#include "objects/fluid/backend/solver/solid_grid.h"

#include <algorithm>
#include <cmath>

namespace grove::objects::fluid {

SolidGrid::SolidGrid(const Layout& layout, const Sides& sides)
    : layout_(layout), sides_(sides), staticAir_(layout.size()), air_(layout.size()) {
  setStatic(std::vector<std::uint8_t>(static_cast<std::size_t>(layout.cells) * layout.cells * layout.cells, 0));
}

void SolidGrid::setStatic(std::span<const std::uint8_t> solid) {
  const int n = layout_.cells;
  assert(solid.size() == static_cast<std::size_t>(n) * n * n);
  staticAir_.clear();
  staticCells_ = 0;
  CellBox::whole(n).forEach([&](int x, int y, int z) {
    const bool isSolid = solid[(static_cast<std::size_t>(z) * n + y) * n + x] != 0;
    staticAir_[layout_.index(x, y, z)] = isSolid ? 0 : 1;
    staticCells_ += isSolid ? 1 : 0;
  });
  // Only ghosts that share a face with a cell matter, so edges and corners may stay closed.
  for (int a = 0; a < 3; ++a) {
    for (const bool high : {false, true}) {
      if (!sides_.open(a, high)) continue;
      for (int j = 0; j < n; ++j) {
        for (int i = 0; i < n; ++i) {
          const int at = high ? n : -1;
          const int x = a == 0 ? at : i;
          const int y = a == 1 ? at : a == 0 ? i : j;
          const int z = a == 2 ? at : j;
          staticAir_[layout_.index(x, y, z)] = 1;
        }
      }
    }
  }
  moving_.clear();
  movingBox_ = {};
  air_.copyFrom(staticAir_);
  changed_ = CellBox::whole(n);
  collectWallFaces();
}

void SolidGrid::collectWallFaces() {
  for (int a = 0; a < 3; ++a) {
    std::vector<std::int32_t>& wallFaces = wallFaces_[static_cast<std::size_t>(a)];
    wallFaces.clear();
    CellBox faces = CellBox::whole(layout_.cells);
    ++faces.high[a];
    faces.forEach([&](int x, int y, int z) {
      const std::ptrdiff_t i = layout_.index(x, y, z);
      if (staticAir_[i] == 0 || staticAir_[i - layout_.step(a)] == 0) wallFaces.push_back(static_cast<std::int32_t>(i));
    });
  }
}

void SolidGrid::setMovers(std::span<const Capsule> movers, float cellSize) {
  const int n = layout_.cells;
  for (const MovingCell& cell : moving_) air_[cell.index] = 1;
  changed_.add(movingBox_);
  moving_.clear();
  movingBox_ = {};
  const auto cellAt = [&](float metres) {
    return static_cast<int>(std::clamp(std::floor(metres / cellSize), -1.0F, static_cast<float>(n)));
  };
  for (const Capsule& mover : movers) {
    CellBox box;
    const world::Vec3 low = mover.foot - world::Vec3(mover.radius, 0.0F, mover.radius);
    const world::Vec3 high = mover.foot + world::Vec3(mover.radius, mover.height, mover.radius);
    for (int a = 0; a < 3; ++a) {
      box.low[a] = std::max(cellAt(low[a]), 0);
      box.high[a] = std::min(cellAt(high[a]) + 1, n);
    }
    if (box.empty()) continue;
    const float bottom = mover.foot.y + mover.radius;
    const float top = std::max(mover.foot.y + mover.height - mover.radius, bottom);
    box.forEach([&](int x, int y, int z) {
      const std::ptrdiff_t i = layout_.index(x, y, z);
      if (air_[i] == 0) return;
      const world::Vec3 centre = (world::Vec3(x, y, z) + 0.5F) * cellSize;
      const world::Vec3 axis(mover.foot.x, std::clamp(centre.y, bottom, top), mover.foot.z);
      const world::Vec3 away = centre - axis;
      if (glm::dot(away, away) > mover.radius * mover.radius) return;
      air_[i] = 0;
      moving_.push_back({i, mover.velocity});
    });
    movingBox_.add(box);
  }
  changed_.add(movingBox_);
}

void SolidGrid::enforce(Velocity& velocity) const {
  for (int a = 0; a < 3; ++a) {
    const std::ptrdiff_t step = layout_.step(a);
    float* faces = velocity.axis(a).data();
    for (const MovingCell& cell : moving_) {
      faces[cell.index] = cell.velocity[a];
      faces[cell.index + step] = cell.velocity[a];
    }
    for (const std::int32_t face : wallFaces_[static_cast<std::size_t>(a)]) faces[face] = 0.0F;
  }
}

CellBox SolidGrid::takeChanges() noexcept { return std::exchange(changed_, {}); }

}  // namespace grove::objects::fluid
