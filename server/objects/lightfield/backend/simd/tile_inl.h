// Tiles of pixels, the unit of the loops. For kernels: included once per target.

#if defined(GROVE_OBJECTS_LIGHTFIELD_BACKEND_SIMD_TILE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef GROVE_OBJECTS_LIGHTFIELD_BACKEND_SIMD_TILE_INL_H
#undef GROVE_OBJECTS_LIGHTFIELD_BACKEND_SIMD_TILE_INL_H
#else
#define GROVE_OBJECTS_LIGHTFIELD_BACKEND_SIMD_TILE_INL_H
#endif

#include <hwy/highway.h>

#include <array>

#include "base/simd/lanes_inl.h"
#include "objects/lightfield/backend/simd/lens.h"

HWY_BEFORE_NAMESPACE();
namespace grove::objects::lightfield::simd::HWY_NAMESPACE {

using namespace grove::simd::HWY_NAMESPACE;

constexpr int kTileWidth = 16;
constexpr int kTileHeight = 16;
constexpr int kGroups = kTileWidth * kTileHeight / kLanes;
/// A vector's pixels form a block, not a row: close pixels have similar marches.
constexpr int kGroupWidth = 4;
constexpr int kGroupHeight = kLanes / kGroupWidth;

/// Position of a group's first pixel in its tile.
HWY_INLINE int groupColumn(int group) { return group % (kTileWidth / kGroupWidth) * kGroupWidth; }
HWY_INLINE int groupRow(int group) { return group / (kTileWidth / kGroupWidth) * kGroupHeight; }

/// One value per pixel of a tile, group by group; a group's lanes are its pixels row by row.
template <typename Lanes>
using Plane = std::array<Lanes, kGroups>;

/// Pixels that are processed together, because neighbours use the same few views and adjacent texels. The point at
/// depth t is eye + t * ray.
struct Tile {
  world::Vec3 eye{0.0F};
  Plane<Floats> rayX, rayY, rayZ;
  Plane<Floats> from, to;  ///< depths where the ray is within the object's bounds; to <= from: nowhere
  Plane<Floats> u, v;      ///< the ray's intersection with the sphere of views, in its lattice
  Plane<Floats> depth;     ///< of the surface, if `found`
  Plane<Mask> found;
  Plane<Mask> guessed;  ///< found, but possibly visible in no view
};

/// A ray's points in a view: the point at depth t has view depth z0 + t * z1, and so on.
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

/// Accumulates min and max.
class Extent {
 public:
  void add(Floats value, Mask mask) {
    low_ = min(low_, select(mask, value, kNone));
    high_ = max(high_, select(mask, value, -kNone));
  }
  [[nodiscard]] float low() const { return minOf(low_); }
  [[nodiscard]] float high() const { return maxOf(high_); }

 private:
  static constexpr float kNone = 1.0e9F;
  Floats low_ = kNone;
  Floats high_ = -kNone;
};

}  // namespace grove::objects::lightfield::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // once per target
