#pragma once

#include <vector>

#include "models/plants/mesh_writer.h"
#include "models/plants/plants.h"
#include "models/plants/random.h"

namespace grove::models {

/// Distance in metres from the nearest edge of a tile around the origin; negative outside.
[[nodiscard]] float insideTile(world::Vec2 place) noexcept;

/// A smooth random field over the whole plane with the symmetry of the tiling: invariant under rotating a tile by 60
/// degrees and moving it from tile to tile (wallpaper group p6). So each tile evaluates it in its own coordinates and
/// agrees with its neighbours at the edges. Values have mean 0 and deviation 1.
class TilingField {
 public:
  /// Wavelengths are between `shortest` and `longest`, metres.
  TilingField(std::uint32_t seed, float shortest, float longest);
  [[nodiscard]] float at(world::Vec2 place) const;

 private:
  struct Wave {
    double x = 0.0;
    double y = 0.0;
    double weight = 0.0;
  };
  std::vector<Wave> waves_;
};

/// The ground of one tile: the common fields near the edges, the tile's own farther inside.
class Soil {
 public:
  /// @param own noise of this tile alone
  explicit Soil(Random own);

  /// Metres.
  [[nodiscard]] float height(world::Vec2 place) const;
  /// Fertility, 0 to 1.
  [[nodiscard]] float thriving(world::Vec2 place) const;

  /// Draws the hexagon and its skirt.
  void draw(MeshWriter& mesh, std::uint16_t material, Detail detail) const;

 private:
  [[nodiscard]] world::Vec3 colour(world::Vec2 place) const;

  world::Vec3 own_{0.0F};
  TilingField relief_;
  TilingField vigour_;
  TilingField grain_;
};

}  // namespace grove::models
