#pragma once

#include <cstdint>
#include <vector>

#include "models/model.h"
#include "objects/lightfield/bake/texture_sampler.h"

namespace grove::bake {

/// A place where light is computed for the patch of surface around it.
struct LightPoint {
  world::Vec3 position{0.0F};
  world::Vec3 normal{0.0F, 1.0F, 0.0F};
  world::Vec3 albedo{0.0F};         ///< mean of the patch, linear
  world::Vec3 transmittance{0.0F};  ///< likewise
  bool bothSides = false;           ///< else the back is lit as the front, for nobody but grazing rays sees it
};

struct LightPoints {
  std::vector<LightPoint> points;       ///< neighbours in space are near each other in the list
  std::vector<std::uint32_t> ofVertex;  ///< index into points
};

/// Which vertices may share a point.
enum class PointsOf {
  kPiece,  ///< those of one connected piece: a leaf that is smaller than a texel has one point
  kCell,   ///< those of all leaves, or of all that is solid, in a cell: far fewer points where leaves are many
};

/// Chooses the light points of a model: vertices that may, are within `cell` metres of each other and face alike share
/// one.
[[nodiscard]] LightPoints chooseLightPoints(const models::Model& model, const std::vector<TextureSampler>& textures,
                                            float cell, PointsOf of = PointsOf::kPiece);

}  // namespace grove::bake
