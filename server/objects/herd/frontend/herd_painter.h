#pragma once

#include <array>

#include "node/frontend/frontend_half.h"
#include "objects/herd/common/herd_snapshot.h"
#include "raster/simd/simd_mesh_renderer.h"

namespace grove::objects::herd {

/// The surfaces of a process's deer and what draws them, for all visitors. Any thread.
class HerdPainter {
 public:
  explicit HerdPainter(const node::FrontendTools& tools);

  [[nodiscard]] const raster::LitSurface& surfaceOf(Kind kind) const { return deer_[static_cast<std::size_t>(kind)]; }
  /// The factor for the permitted errors of pictures, more than 1: a busy machine draws coarser deer.
  [[nodiscard]] float coarseness() const;
  /// Null if the drawing's rectangle is empty.
  [[nodiscard]] std::shared_ptr<const raster::Image> paint(const raster::Drawing& drawing);

 private:
  const pipeline::Executor& workers_;
  const std::array<raster::LitSurface, kKinds> deer_;
  raster::SimdMeshRenderer renderer_;
  const pipeline::HeldMemory held_;
};

}  // namespace grove::objects::herd
