#pragma once

#include <array>
#include <span>
#include <vector>

#include "objects/lightfield/format/view_camera.h"
#include "raster/image.h"
#include "world/object.h"

namespace grove::objects::lightfield {

/// Where a tile of plants has no neighbour. There its plants are shorter and end in an irregular line, so that a patch
/// of tiles has no straight edges. Across-user: made once per object.
struct Rims {
  /// An edge of the hexagon without a neighbour, object coordinates (x and z).
  struct Edge {
    world::Vec2 middle;
    world::Vec2 along;  ///< unit vector
  };
  /// A triangle wave over the ground: its phase at a point is dot(vector, point) + offset, in periods.
  struct Wave {
    world::Vec2 vector;
    float offset;
  };

  std::vector<Edge> edges;
  std::array<Wave, 6> waves{};  ///< the same on all tiles of a world, in object coordinates
};

/// `objects`: all objects of the world; those at the places of neighbours are taken for tiles.
[[nodiscard]] Rims rimsOf(const world::Object& tile, std::span<const world::Object> objects);

/// Removes plants near the rims from a picture of the tile. `camera` is the image's camera. Vectorised; any thread.
void thinRims(const Rims& rims, const ObjectCamera& camera, raster::Image& image);

}  // namespace grove::objects::lightfield
