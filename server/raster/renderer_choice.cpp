#include "raster/renderer_choice.h"

#include <cassert>

#include "gl/workers.h"
#include "raster/embree/embree_mesh_renderer.h"
#include "raster/gl/gl_mesh_renderer.h"
#include "raster/simd/simd_mesh_renderer.h"

namespace grove::raster {

std::unique_ptr<MeshRenderer> makeRenderer(RendererKind kind, gl::Workers& gl, ImagePool& images,
                                           const MeshMemory& memory) {
  assert(kind != RendererKind::kAuto);
  if (kind == RendererKind::kGl) return std::make_unique<GlMeshRenderer>(gl, images, memory);
  if (kind == RendererKind::kSimd) return std::make_unique<SimdMeshRenderer>(images, memory);
  return std::make_unique<EmbreeMeshRenderer>(images);
}

pipeline::Executor& executorFor(RendererKind kind, gl::Workers& gl, pipeline::Executor& workers) noexcept {
  return kind == RendererKind::kGl ? static_cast<pipeline::Executor&>(gl) : workers;
}

}  // namespace grove::raster
