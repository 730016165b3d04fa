#include "raster/simd/simd_mesh_renderer.h"

#include <utility>

#include "raster/shading/detail.h"
#include "raster/shading/vertex_light.h"
#include "raster/simd/cut_triangles.h"
#include "raster/simd/triangle_kernels.h"

namespace grove::raster {

/// The memory of one thread's drawing at hand.
struct SimdMeshRenderer::Bench {
  ScreenVertices vertices;
  CutTriangles cut;
  Canvas canvas;

  [[nodiscard]] std::size_t bytes() const noexcept {
    return vertices.bytes() + pipeline::vectorBytes(cut.corners, cut.triangles) + canvas.bytes();
  }
};

SimdMeshRenderer::SimdMeshRenderer(ImagePool& images, const MeshMemory& memory)
    : images_(images), held_(memory.held("buffers")) {}

SimdMeshRenderer::~SimdMeshRenderer() = default;

void SimdMeshRenderer::render(std::span<const Drawing> drawings, std::span<std::shared_ptr<Image>> images) {
  std::unique_ptr<Bench> bench = takeBench();
  for (std::size_t i = 0; i < drawings.size(); ++i) {
    if (!drawings[i].rect.empty()) images[i] = renderOne(drawings[i], *bench);
  }
  giveBack(std::move(bench));
}

const VertexArrays& SimdMeshRenderer::arraysOf(const LitSurface& object) {
  const std::lock_guard lock(mutex_);
  const auto [it, isNew] = arrays_.try_emplace(&object, object);
  if (isNew) arrayBytes_ += it->second.bytes();
  return it->second;
}

std::unique_ptr<SimdMeshRenderer::Bench> SimdMeshRenderer::takeBench() {
  const std::lock_guard lock(mutex_);
  if (benches_.empty()) return std::make_unique<Bench>();
  std::unique_ptr<Bench> bench = std::move(benches_.back());
  benches_.pop_back();
  return bench;
}

void SimdMeshRenderer::giveBack(std::unique_ptr<Bench> bench) {
  const std::lock_guard lock(mutex_);
  benches_.push_back(std::move(bench));
  std::size_t sum = texture_.bytes() + arrayBytes_;
  for (const auto& unused : benches_) sum += unused->bytes();
  held_.set(sum);
}

std::shared_ptr<Image> SimdMeshRenderer::renderOne(const Drawing& drawing, Bench& bench) {
  const Level& level = drawing.object->surface.levelFor(drawing.distance, drawing.camera->focal());
  const VertexArrays& arrays = arraysOf(*drawing.object);
  const float nearDepth = drawing.camera->nearDepth;
  ScreenVertices& vertices = bench.vertices;
  Canvas& canvas = bench.canvas;
  vertices.light.resize(level.vertexCount);
  lightVertices(arrays, drawing, vertices.light);
  project(arrays, drawing, vertices);
  canvas.begin(drawing.rect);
  if (vertices.nearest < nearDepth) {
    cut(level.triangles, vertices, arrays.lichen, nearDepth, bench.cut);
    drawTriangles(bench.cut.triangles, bench.cut.corners, canvas);
  } else {
    drawTriangles(level.triangles, vertices.corners, canvas);
  }
  const std::shared_ptr<Image> image = images_.acquire(drawing.rect);
  finish({canvas.surface.data(), canvas.depth.data(), canvas.stride, canvas.spans}, drawing, texture_, *image);
  return image;
}

}  // namespace grove::raster
