#include "objects/mesh/simd_mesh_renderer.h"

#include <utility>

#include "objects/mesh/detail.h"
#include "objects/mesh/near_clip.h"
#include "objects/mesh/rasteriser.h"
#include "objects/mesh/vertex_light.h"

namespace grove::objects::mesh {
namespace {

/// A triangle that may reach before the near depth.
void drawClipped(const Triangle& triangle, const ScreenVertices& vertices, const std::vector<float>& lichen,
                 float nearDepth, Canvas& canvas) {
  const auto vertex = [&](std::size_t corner) {
    return vertices.clipVertex(triangle[corner], lichen[triangle[corner]]);
  };
  const NearClip clip({vertex(0), vertex(1), vertex(2)}, nearDepth);
  const std::span<const ClipVertex> polygon = clip.polygon();
  for (std::size_t i = 2; i < polygon.size(); ++i) {
    drawTriangle(projected(polygon[0], nearDepth), projected(polygon[i - 1], nearDepth),
                 projected(polygon[i], nearDepth), canvas);
  }
}

}  // namespace

/// The memory of one thread's drawing at hand.
struct SimdMeshRenderer::Bench {
  ScreenVertices vertices;
  Canvas canvas;
};

SimdMeshRenderer::SimdMeshRenderer(node::ImagePool& images, const MeshMemory& memory)
    : images_(images), held_(memory.held("buffers")) {}

SimdMeshRenderer::~SimdMeshRenderer() = default;

void SimdMeshRenderer::render(std::span<const Drawing> drawings, std::span<std::shared_ptr<const node::Image>> images) {
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
  for (const auto& unused : benches_) sum += unused->vertices.bytes() + unused->canvas.bytes();
  held_.set(sum);
}

std::shared_ptr<const node::Image> SimdMeshRenderer::renderOne(const Drawing& drawing, Bench& bench) {
  const Level& level = drawing.object->surface.levelFor(drawing.distance, drawing.camera->focal());
  const VertexArrays& arrays = arraysOf(*drawing.object);
  const float nearDepth = drawing.camera->nearDepth;
  ScreenVertices& vertices = bench.vertices;
  Canvas& canvas = bench.canvas;
  vertices.light.resize(level.vertexCount);
  lightVertices(arrays, drawing, vertices.light);
  project(arrays, drawing, vertices);
  canvas.begin(drawing.rect);
  const std::vector<Corner>& corners = vertices.corners;
  const bool clipped = vertices.nearest < nearDepth;
  for (const Triangle& triangle : level.triangles) {
    if (clipped) {
      drawClipped(triangle, vertices, arrays.lichen, nearDepth, canvas);
    } else {
      drawTriangle(corners[triangle[0]], corners[triangle[1]], corners[triangle[2]], canvas);
    }
  }
  const std::shared_ptr<node::Image> image = images_.acquire(drawing.rect);
  finish({canvas.surface.data(), canvas.depth.data(), canvas.stride, canvas.spans}, drawing, texture_, *image);
  return image;
}

}  // namespace grove::objects::mesh
