#pragma once

#include <map>
#include <memory>
#include <mutex>

#include "raster/drawing.h"
#include "raster/shading/detail_texture.h"
#include "world/rays/ray_scene.h"

namespace grove::raster {

/// Traces one ray per pixel against the same triangles. Slow and exact: the reference for faster renderers. Any thread.
/// Draws only rigid surfaces: all vertices follow the first bone.
class EmbreeMeshRenderer final : public MeshRenderer {
 public:
  /// `images` outlives the renderer.
  explicit EmbreeMeshRenderer(ImagePool& images) : images_(images) {}

  void render(std::span<const Drawing> drawings, std::span<std::shared_ptr<Image>> images) override;

 private:
  [[nodiscard]] const world::RayScene& raysOf(const Surface& surface, const Level& level);
  [[nodiscard]] std::shared_ptr<Image> renderOne(const Drawing& drawing);

  const DetailTexture texture_;
  ImagePool& images_;
  std::mutex mutex_;
  std::map<const Level*, world::RayScene> rays_;
};

}  // namespace grove::raster
