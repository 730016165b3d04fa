#pragma once

#include <optional>

#include "objects/lightfield/format/light_field.h"
#include "world/geometry.h"

/// What the voxels of a light field mean to the rest of the world, in the object's coordinates.
namespace grove::objects::lightfield {

/// The closed surface of the wood.
[[nodiscard]] world::Triangles woodSurface(const VoxelGrid& voxels);

/// The wood, and for each cell of leaves a card that lets some light by, so that the shade is dappled.
[[nodiscard]] world::Triangles shadeSurface(const VoxelGrid& voxels);

/// Radius of the upright cylinder that holds the wood at the height of a visitor's chest; none if there is no wood.
[[nodiscard]] std::optional<float> trunkRadius(const VoxelGrid& voxels);

}  // namespace grove::objects::lightfield
