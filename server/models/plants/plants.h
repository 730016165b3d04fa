#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "models/model.h"

namespace grove::models {

/// Number of triangles: full for several million, small for light fields with few texels, distant for trees of a group
/// that is seen from tens of metres.
enum class Detail { kDistant, kSmall, kFull };

/// The names that makePlant() accepts: trees, groups of trees, and hexagonal tiles of grass.
[[nodiscard]] std::span<const std::string_view> plantNames();

/// Whether a plant is a group of trees, made to be seen from tens of metres.
[[nodiscard]] bool isGroup(std::string_view name);

/// Whether a plant is a tile. Tiles are hexagons of circumradius kTileRadius with corners at +-x, identical along their
/// six edges, so that any two fit at any edge and in any of six rotations.
[[nodiscard]] bool isTile(std::string_view name);
inline constexpr float kTileRadius = 2.0F;

/// The centres of the 18 tiles in the two rings around a tile at the origin.
[[nodiscard]] std::vector<world::Vec3> neighbouringTiles();

/// Increment if the same name, seed and detail give other bytes than before, so that results made from them are
/// rebuilt.
inline constexpr int kPlantsVersion = 4;

/// The same name, seed and detail give the same bytes. Asserts that the name is known.
[[nodiscard]] Model makePlant(std::string_view name, std::uint32_t seed, Detail detail);

}  // namespace grove::models
