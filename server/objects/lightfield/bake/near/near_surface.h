#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "models/model.h"
#include "objects/lightfield/bake/light/light_points.h"
#include "objects/lightfield/bake/light/surface_light.h"
#include "objects/lightfield/format/near_model.h"

namespace grove::bake {

/// The memory of a NearModel.
struct NearSurface {
  std::vector<objects::lightfield::NearCluster> clusters;
  std::array<std::vector<float>, 3> positions;
  std::vector<objects::lightfield::NearFace> faces;
  std::vector<std::vector<std::uint32_t>> colours;  ///< by lighting

  [[nodiscard]] objects::lightfield::NearModel model() const;
};

/// Divides a lit model into clusters with display-encoded colours. Empty for a model with textures, whose triangles do
/// not show what it looks like, and for one with too many triangles.
[[nodiscard]] NearSurface makeNearSurface(const models::Model& model, const LightPoints& points,
                                          const SurfaceLight& light);

}  // namespace grove::bake
