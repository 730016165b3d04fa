#pragma once

#include <optional>

#include "models/model.h"
#include "raster/renderer_choice.h"
#include "raster/surface.h"
#include "world/object.h"
#include "world/scenes/scene_file.h"

namespace grove::objects::mesh {

/// One mesh of the scene file.
///
/// Keys: shape (stone, lintel, rocks, logs), seed, height, width, depth (metres), renderer; or, as for a light field,
/// plant and seed, or model (a glTF file). Accepts and ignores the light field's own keys, so that changing an object's
/// type means changing one word.
class MeshModel final : public world::Model {
 public:
  /// Throws world::SceneError.
  explicit MeshModel(const world::Parameters& parameters);

  /// A custom closed surface; it does not block visitors.
  MeshModel(raster::Surface surface, raster::RendererKind renderer);

  [[nodiscard]] world::Bounds bounds() const override { return bounds_; }
  /// Null for a camp fire: its smoke must rise through the logs, which are too small for the fluid's grid.
  [[nodiscard]] const world::Triangles* solid() const override { return solid_ ? &*solid_ : nullptr; }
  [[nodiscard]] const world::Triangles* shade() const override { return shade_ ? &*shade_ : solid(); }
  [[nodiscard]] std::optional<float> obstacleRadius() const override { return obstacleRadius_; }
  [[nodiscard]] std::size_t bytes() const override {
    return surface_.bytes() + (solid_ ? solid_->bytes() : 0) + (shade_ ? shade_->bytes() : 0);
  }

  [[nodiscard]] const raster::Surface& surface() const noexcept { return surface_; }
  [[nodiscard]] raster::RendererKind renderer() const noexcept { return renderer_; }

 private:
  void makeShape(const world::Parameters& parameters);
  void makeModel(models::Model given);

  raster::RendererKind renderer_ = raster::RendererKind::kAuto;
  raster::Surface surface_;
  std::optional<world::Triangles> solid_;
  std::optional<world::Triangles> shade_;  ///< if it has more than the solid
  world::Bounds bounds_;
  std::optional<float> obstacleRadius_;
};

}  // namespace grove::objects::mesh
