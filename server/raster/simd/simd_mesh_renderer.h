#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <vector>

#include "raster/drawing.h"
#include "raster/shading/detail_texture.h"
#include "raster/vertex_arrays.h"

namespace grove::raster {

/// Rasterises with the CPU's vectors: several times cheaper than software GL, whose shaders, tiles and read-back are
/// made for more than small untextured triangles. Any thread, any number at once.
class SimdMeshRenderer final : public MeshRenderer {
 public:
  /// `images` outlives the renderer.
  SimdMeshRenderer(ImagePool& images, const MeshMemory& memory);
  ~SimdMeshRenderer() override;

  void render(std::span<const Drawing> drawings, std::span<std::shared_ptr<Image>> images) override;

 private:
  struct Scratch;
  [[nodiscard]] const VertexArrays& arraysOf(const LitSurface& object);
  [[nodiscard]] std::unique_ptr<Scratch> takeScratch();
  void giveBack(std::unique_ptr<Scratch> scratch);
  [[nodiscard]] std::shared_ptr<Image> renderOne(const Drawing& drawing, Scratch& scratch);

  const DetailTexture texture_;
  ImagePool& images_;
  std::mutex mutex_;
  std::map<const LitSurface*, VertexArrays> arrays_;
  std::vector<std::unique_ptr<Scratch>> unused_;  // not in use
  std::size_t arrayBytes_ = 0;
  pipeline::HeldMemory held_;
};

}  // namespace grove::raster
