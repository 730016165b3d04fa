#pragma once

#include <cstdint>
#include <span>

#include "objects/lightfield/backend/near/near_tiles.h"
#include "objects/lightfield/format/near_model.h"
#include "world/geometry.h"

namespace grove::objects::lightfield {

/// Dot products of (x, y, z, 1) in object coordinates.
struct NearProjection {
  world::Vec4 x{0.0F};      ///< pixels from the picture's left edge, times depth
  world::Vec4 y{0.0F};      ///< pixels from its top edge, times depth
  world::Vec4 depth{0.0F};  ///< view depth, metres
};

/// Adds a cluster's visible faces to the tiles. `fronts` and `backs`: all colours of one lighting.
void projectCluster(const NearModel& model, const NearCluster& cluster, std::span<const std::uint32_t> fronts,
                    std::span<const std::uint32_t> backs, const NearProjection& projection, NearTiles& tiles);

}  // namespace grove::objects::lightfield
