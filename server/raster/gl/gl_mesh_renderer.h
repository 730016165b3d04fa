#pragma once

#include <memory>
#include <vector>

#include "gl/workers.h"
#include "raster/drawing.h"
#include "raster/shading/detail_texture.h"

namespace grove::raster {

/// Rasterises with GL. A batch is drawn as tiles of one atlas, whoever they are for, then read back and finished:
/// GL interpolates light and depth over triangles, and what needs many operations a pixel is left to wider loops.
class GlMeshRenderer final : public MeshRenderer {
 public:
  /// All outlive the renderer.
  GlMeshRenderer(gl::Workers& workers, ImagePool& images, const MeshMemory& memory);
  /// Not on a worker: waits for each to drop its buffers.
  ~GlMeshRenderer() override;

  /// On a worker. What a worker needs is made at its first call; throws EnvironmentError if that fails.
  void render(std::span<const Drawing> drawings, std::span<std::shared_ptr<Image>> images) override;

 private:
  class Target;
  const DetailTexture texture_;
  gl::Workers& workers_;
  ImagePool& images_;
  const MeshMemory memory_;
  std::vector<std::unique_ptr<Target>> targets_;  // by worker, each used by its thread alone
};

}  // namespace grove::raster
