#pragma once

#include <cstdint>
#include <vector>

#include "models/model.h"
#include "objects/lightfield/bake/texture_sampler.h"

namespace grove::bake {

/// A point that represents the patch of surface around it in light computations.
struct LightPoint {
  world::Vec3 position{0.0F};
  world::Vec3 normal{0.0F, 1.0F, 0.0F};
  world::Vec3 albedo{0.0F};         ///< mean of the patch, linear
  world::Vec3 transmittance{0.0F};  ///< mean of the patch, linear
  bool bothSides = false;           ///< else the back is lit like the front, because only grazing rays see it
};

struct LightPoints {
  std::vector<LightPoint> points;       ///< neighbours in space are near each other in the list
  std::vector<std::uint32_t> ofVertex;  ///< index into points
};

/// Condition for vertices to share a point.
enum class PointsOf {
  kPiece,  ///< same connected piece: a leaf smaller than a texel has one point
  kCell,   ///< same cell, leaves and solid apart: far fewer points for dense leaves
};

/// Chooses a model's light points: vertices share one if `of` permits it, they are within `cell` metres of each
/// other and their normals are similar.
[[nodiscard]] LightPoints chooseLightPoints(const models::Model& model, const std::vector<TextureSampler>& textures,
                                            float cell, PointsOf of = PointsOf::kPiece);

}  // namespace grove::bake
