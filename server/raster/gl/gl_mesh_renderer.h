#pragma once

#include <memory>
#include <vector>

#include "gl/workers.h"
#include "raster/drawing.h"
#include "raster/shading/detail_texture.h"

namespace grove::raster {

/// Rasterises with GL. Draws a batch as tiles of one atlas, independent of their sessions, then reads it back and
/// finishes it on the CPU: GL interpolates light and depth over triangles, and the vectorised loops do the expensive
/// work per pixel.
class GlMeshRenderer final : public MeshRenderer {
 public:
  /// All arguments outlive the renderer.
  GlMeshRenderer(gl::Workers& workers, ImagePool& images, const MeshMemory& memory);
  /// Not on a worker: waits until each has dropped its buffers.
  ~GlMeshRenderer() override;

  /// On a worker. Creates the worker's resources on its first call; throws EnvironmentError if that fails.
  void render(std::span<const Drawing> drawings, std::span<std::shared_ptr<Image>> images) override;

 private:
  class Target;
  const DetailTexture texture_;
  gl::Workers& workers_;
  ImagePool& images_;
  const MeshMemory memory_;
  std::vector<std::unique_ptr<Target>> targets_;  // one per worker, used only by its thread
};

}  // namespace grove::raster
