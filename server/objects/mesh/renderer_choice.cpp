#include "objects/mesh/renderer_choice.h"

#include <cassert>

#include "gl/workers.h"
#include "objects/mesh/embree_mesh_renderer.h"
#include "objects/mesh/gl_mesh_renderer.h"
#include "objects/mesh/simd_mesh_renderer.h"

namespace grove::objects::mesh {

RendererKind resolved(RendererKind kind, const gl::Workers& gl) noexcept {
  if (kind != RendererKind::kAuto) return kind;
  return gl.softwareRendered() ? RendererKind::kSimd : RendererKind::kGl;
}

std::unique_ptr<MeshRenderer> makeRenderer(RendererKind kind, const node::BackendServices& services,
                                           std::string_view type) {
  const MeshMemory memory{services.memory, type};
  assert(kind != RendererKind::kAuto);
  if (kind == RendererKind::kGl) return std::make_unique<GlMeshRenderer>(services.gl, services.images, memory);
  if (kind == RendererKind::kSimd) return std::make_unique<SimdMeshRenderer>(services.images, memory);
  return std::make_unique<EmbreeMeshRenderer>(services.images);
}

pipeline::Executor& executorFor(RendererKind kind, const node::BackendServices& services) noexcept {
  return kind == RendererKind::kGl ? static_cast<pipeline::Executor&>(services.gl) : services.workers;
}

}  // namespace grove::objects::mesh
