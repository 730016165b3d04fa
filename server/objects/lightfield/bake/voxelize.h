#pragma once

#include <cstdint>
#include <vector>

#include "models/model.h"
#include "objects/lightfield/format/light_field.h"

namespace grove::bake {

struct Voxels {
  objects::lightfield::VoxelGrid grid;  ///< without cells, which are in `cells`
  std::vector<std::uint8_t> cells;
};

/// Voxels of a grid around the model, `longest` cells along its longest edge. A cell is wood if bodies of solid
/// material fill a good part of it (by the rays' entries and exits, so a mere sheet is no body), and leaves if other
/// triangles in it have enough area.
[[nodiscard]] Voxels voxelize(const models::Model& model, int longest);

}  // namespace grove::bake
