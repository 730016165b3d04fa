#pragma once

#include <optional>

#include "objects/mesh/surface.h"
#include "world/object.h"
#include "world/scene_file.h"

namespace grove::objects::mesh {

/// What draws an object: `renderer = "gl" | "embree"`.
enum class RendererKind { kGl, kEmbree };

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
  [[nodiscard]] const world::Triangles* solid() const override { return &solid_; }
  [[nodiscard]] std::optional<float> obstacleRadius() const override { return obstacleRadius_; }

  [[nodiscard]] const Surface& surface() const noexcept { return surface_; }
  [[nodiscard]] RendererKind renderer() const noexcept { return renderer_; }

 private:
  RendererKind renderer_ = RendererKind::kGl;
  Surface surface_;
  world::Triangles solid_;
  world::Bounds bounds_;
  std::optional<float> obstacleRadius_;
};

}  // namespace grove::objects::mesh
