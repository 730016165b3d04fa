#pragma once

#include <optional>

#include "objects/mesh/renderer_choice.h"
#include "objects/mesh/surface.h"
#include "world/object.h"
#include "world/scene_file.h"

namespace grove::objects::mesh {

/// One mesh of the scene file.
///
/// Keys: shape (stone, lintel, rocks, logs), seed, height, width, depth (metres), renderer.
class MeshModel final : public world::Model {
 public:
  /// Throws world::SceneError.
  explicit MeshModel(const world::Parameters& parameters);

  /// A closed surface of one's own; nobody is kept from walking through it.
  MeshModel(Surface surface, RendererKind renderer);

  [[nodiscard]] world::Bounds bounds() const override { return bounds_; }
  /// Null for a camp fire: its smoke must rise through the logs, which are too small for the fluid's grid.
  [[nodiscard]] const world::Triangles* solid() const override { return solid_ ? &*solid_ : nullptr; }
  [[nodiscard]] std::optional<float> obstacleRadius() const override { return obstacleRadius_; }

  [[nodiscard]] const Surface& surface() const noexcept { return surface_; }
  [[nodiscard]] RendererKind renderer() const noexcept { return renderer_; }

 private:
  RendererKind renderer_ = RendererKind::kAuto;
  Surface surface_;
  std::optional<world::Triangles> solid_;
  world::Bounds bounds_;
  std::optional<float> obstacleRadius_;
};

}  // namespace grove::objects::mesh
