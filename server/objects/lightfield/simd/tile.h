#pragma once

#include <array>

#include "objects/lightfield/simd/lanes.h"
#include "objects/lightfield/simd/lens.h"
#include "objects/lightfield/simd/texel_window.h"

namespace grove::objects::lightfield::simd {

inline constexpr int kTileWidth = 16;
inline constexpr int kTileHeight = 16;
inline constexpr int kGroups = kTileWidth * kTileHeight / kLanes;
/// A vector's pixels are a block and not a row: the closer they are, the more alike are their walks.
inline constexpr int kGroupWidth = 4;
inline constexpr int kGroupHeight = kLanes / kGroupWidth;

/// Where a group's first pixel is in its tile.
inline int groupColumn(int group) { return group % (kTileWidth / kGroupWidth) * kGroupWidth; }
inline int groupRow(int group) { return group / (kTileWidth / kGroupWidth) * kGroupHeight; }

/// One value for each pixel of a tile, group by group; a group's lanes are its pixels row by row.
template <typename Lanes>
using Plane = std::array<Lanes, kGroups>;

/// Pixels that are worked on together, for neighbours look at the same few views and at neighbouring texels there. The
/// point at depth t is eye + t * ray.
struct Tile {
  world::Vec3 eye{0.0F};
  Plane<Floats> rayX, rayY, rayZ;
  Plane<Floats> from, to;  ///< depths where the ray is within the object's bounds; to <= from: nowhere
  Plane<Floats> u, v;      ///< where the ray enters the sphere of views, in its lattice
  Plane<Floats> depth;     ///< of the surface, where `found`
  Plane<Ints> found;
  Plane<Ints> guessed;  ///< found, but no view may show it
};

/// Where a ray's points are seen by a view: the point at depth t has view depth z0 + t * z1, and so on.
struct Sight {
  float x0, y0, z0;
  Floats x1, y1, z1;

  Sight(const Tile& tile, int group, const Lens& lens)
      : x0(glm::dot(lens.column, tile.eye - lens.eye)),
        y0(glm::dot(lens.row, tile.eye - lens.eye)),
        z0(glm::dot(lens.forward, tile.eye - lens.eye)) {
    const auto g = static_cast<std::size_t>(group);
    const Floats rx = tile.rayX[g];
    const Floats ry = tile.rayY[g];
    const Floats rz = tile.rayZ[g];
    x1 = lens.column.x * rx + lens.column.y * ry + lens.column.z * rz;
    y1 = lens.row.x * rx + lens.row.y * ry + lens.row.z * rz;
    z1 = lens.forward.x * rx + lens.forward.y * ry + lens.forward.z * rz;
  }
};

/// The lenses of a request, made when they are first needed. Not for use by several threads.
class Lenses {
 public:
  Lenses(const LightField& field, int level) : field_(field), level_(level) {}
  [[nodiscard]] const Lens& of(int view) {
    Lens& lens = recent_[static_cast<std::size_t>(view) % recent_.size()];
    if (lens.view != view) lens = makeLens(field_, level_, view);
    return lens;
  }

 private:
  const LightField& field_;
  int level_;
  std::array<Lens, 61> recent_;
};

/// The smallest and the largest of what it is given.
class Extent {
 public:
  void add(Floats value, Ints mask) {
    low_ = least(low_, mask ? value : all(kNone));
    high_ = most(high_, mask ? value : all(-kNone));
  }
  [[nodiscard]] float low() const { return leastOf(low_); }
  [[nodiscard]] float high() const { return mostOf(high_); }

 private:
  static constexpr float kNone = 1.0e9F;
  Floats low_ = all(kNone);
  Floats high_ = all(-kNone);
};

}  // namespace grove::objects::lightfield::simd
