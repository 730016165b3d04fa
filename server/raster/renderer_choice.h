#pragma once

#include <memory>

#include "pipeline/executor.h"
#include "raster/drawing.h"

namespace grove::gl {
class Workers;
}

namespace grove::raster {

/// The renderer of an object: `renderer = "auto" | "gl" | "simd" | "embree"`.
enum class RendererKind {
  kAuto,  ///< GL on a GPU, SIMD where GL is software
  kGl,
  kSimd,
  kEmbree,
};

/// `kind` is a result of gl::resolved(). `gl` and `images` outlive the renderer.
[[nodiscard]] std::unique_ptr<MeshRenderer> makeRenderer(RendererKind kind, gl::Workers& gl, ImagePool& images,
                                                         const MeshMemory& memory);

/// The executor of a renderer of a resolved kind.
[[nodiscard]] pipeline::Executor& executorFor(RendererKind kind, gl::Workers& gl, pipeline::Executor& workers) noexcept;

}  // namespace grove::raster
