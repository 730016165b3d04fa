#pragma once

#include <memory>
#include <string_view>

#include "node/object_type.h"
#include "objects/mesh/drawing.h"

namespace grove::objects::mesh {

/// What draws an object: `renderer = "auto" | "gl" | "simd" | "embree"`.
enum class RendererKind {
  kAuto,  ///< GL on a GPU, SIMD where GL is software
  kGl,
  kSimd,
  kEmbree,
};

/// What kAuto means on this machine; every other kind is itself.
[[nodiscard]] RendererKind resolved(RendererKind kind, const gl::Workers& gl) noexcept;

/// `kind` is a resolved one. What it needs of the services outlives the renderer.
[[nodiscard]] std::unique_ptr<MeshRenderer> makeRenderer(RendererKind kind, const node::BackendServices& services,
                                                         std::string_view type);

/// Where a renderer of a resolved kind runs.
[[nodiscard]] pipeline::Executor& executorFor(RendererKind kind, const node::BackendServices& services) noexcept;

}  // namespace grove::objects::mesh
