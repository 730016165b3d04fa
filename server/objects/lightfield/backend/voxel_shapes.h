#pragma once

#include <optional>

#include "objects/lightfield/format/light_field.h"
#include "world/geometry.h"

/// Shapes of a light field's voxels for the rest of the world, in object coordinates.
namespace grove::objects::lightfield {

/// The closed surface of the wood.
[[nodiscard]] world::Triangles woodSurface(const VoxelGrid& voxels);

/// The wood plus one card per cell of leaves, smaller than the cell, so that the shade is dappled.
[[nodiscard]] world::Triangles shadeSurface(const VoxelGrid& voxels);

/// Radius of the upright cylinder around the wood at the height of a visitor's chest; nothing if there is no wood.
[[nodiscard]] std::optional<float> trunkRadius(const VoxelGrid& voxels);

}  // namespace grove::objects::lightfield
