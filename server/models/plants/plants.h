#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "models/model.h"

namespace grove::models {

/// How many triangles: small for light fields of few texels, full for several million.
enum class Detail { kSmall, kFull };

/// Names that makePlant() knows: trees and hexagonal tiles of grass.
[[nodiscard]] std::span<const std::string_view> plantNames();

/// Whether a plant is a tile; tiles are hexagons of circumradius kTileRadius with corners at +-x, identical along their
/// six edges, so that any two fit at any edge and in any of six rotations.
[[nodiscard]] bool isTile(std::string_view name);
inline constexpr float kTileRadius = 2.0F;

/// Goes up when the same name, seed and detail begin to give other bytes, so that what was made of them is made anew.
inline constexpr int kPlantsVersion = 3;

/// The same name, seed and detail give the same bytes. Asserts that the name is known.
[[nodiscard]] Model makePlant(std::string_view name, std::uint32_t seed, Detail detail);

}  // namespace grove::models
