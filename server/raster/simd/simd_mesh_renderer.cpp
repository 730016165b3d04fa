#include "raster/simd/simd_mesh_renderer.h"

#include <utility>

#include "raster/outline/outline.h"
#include "raster/simd/screen_surface.h"
#include "raster/simd/triangle_kernels.h"

namespace grove::raster {

/// Scratch buffers of one thread.
struct SimdMeshRenderer::Scratch {
  ScreenSurface surface;
  Outline outline;
  Canvas canvas;

  [[nodiscard]] std::size_t bytes() const noexcept { return surface.bytes() + outline.bytes() + canvas.bytes(); }
};

SimdMeshRenderer::SimdMeshRenderer(ImagePool& images, const MeshMemory& memory)
    : images_(images), held_(memory.held("buffers")) {}

SimdMeshRenderer::~SimdMeshRenderer() = default;

void SimdMeshRenderer::render(std::span<const Drawing> drawings, std::span<std::shared_ptr<Image>> images) {
  std::unique_ptr<Scratch> scratch = takeScratch();
  for (std::size_t i = 0; i < drawings.size(); ++i) {
    if (!drawings[i].rect.empty()) images[i] = renderOne(drawings[i], *scratch);
  }
  giveBack(std::move(scratch));
}

const VertexArrays& SimdMeshRenderer::arraysOf(const LitSurface& object) {
  const std::lock_guard lock(mutex_);
  const auto [it, isNew] = arrays_.try_emplace(&object, object);
  if (isNew) arrayBytes_ += it->second.bytes();
  return it->second;
}

std::unique_ptr<SimdMeshRenderer::Scratch> SimdMeshRenderer::takeScratch() {
  const std::lock_guard lock(mutex_);
  if (unused_.empty()) return std::make_unique<Scratch>();
  std::unique_ptr<Scratch> scratch = std::move(unused_.back());
  unused_.pop_back();
  return scratch;
}

void SimdMeshRenderer::giveBack(std::unique_ptr<Scratch> scratch) {
  const std::lock_guard lock(mutex_);
  unused_.push_back(std::move(scratch));
  std::size_t sum = texture_.bytes() + arrayBytes_;
  for (const auto& unused : unused_) sum += unused->bytes();
  held_.set(sum);
}

std::shared_ptr<Image> SimdMeshRenderer::renderOne(const Drawing& drawing, Scratch& scratch) {
  ScreenSurface& surface = scratch.surface;
  Canvas& canvas = scratch.canvas;
  surface.make(drawing, arraysOf(*drawing.object));
  canvas.begin(drawing.rect);
  drawTriangles(surface.triangles(), surface.corners(), canvas);
  std::shared_ptr<Image> image = images_.acquire(drawing.rect);
  scratch.outline.find(drawing, surface);
  scratch.outline.finish({canvas.surface.data(), canvas.depth.data(), canvas.stride, canvas.spans}, drawing, texture_,
                         *image);
  return image;
}

}  // namespace grove::raster
