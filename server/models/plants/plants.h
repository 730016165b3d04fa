#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "models/model.h"

namespace grove::models {

/// Number of triangles: small for light fields with few texels, full for several million.
enum class Detail { kSmall, kFull };

/// The names that makePlant() accepts: trees and hexagonal tiles of grass.
[[nodiscard]] std::span<const std::string_view> plantNames();

/// Whether a plant is a tile. Tiles are hexagons of circumradius kTileRadius with corners at +-x, identical along their
/// six edges, so that any two fit at any edge and in any of six rotations.
[[nodiscard]] bool isTile(std::string_view name);
inline constexpr float kTileRadius = 2.0F;

/// Increment if the same name, seed and detail give other bytes than before, so that results made from them are
/// rebuilt.
inline constexpr int kPlantsVersion = 4;

/// The same name, seed and detail give the same bytes. Asserts that the name is known.
[[nodiscard]] Model makePlant(std::string_view name, std::uint32_t seed, Detail detail);

}  // namespace grove::models
