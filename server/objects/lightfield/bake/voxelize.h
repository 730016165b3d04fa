#pragma once

#include <cstdint>
#include <vector>

#include "models/model.h"
#include "objects/lightfield/format/light_field.h"

namespace grove::bake {

struct Voxels {
  objects::lightfield::VoxelGrid grid;  ///< its cells are not set: they are `cells`
  std::vector<std::uint8_t> cells;
};

/// Cells of a grid around the model, `longest` along its longest edge. Wood is where bodies of solid material fill a
/// good part of the cell (rays count where they enter and leave them, so a mere sheet is no body); leaves are where
/// other triangles have a fair area.
[[nodiscard]] Voxels voxelize(const models::Model& model, int longest);

}  // namespace grove::bake
