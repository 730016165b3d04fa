#pragma once

#include <vector>

#include "node/frontend/backdrops/backdrop.h"
#include "node/frontend/backdrops/backdrop_kernels.h"
#include "node/frontend/compositing/composite.h"

namespace grove::node {

/// Shows a backdrop in a frame. Corners of cells of 8 x 8 pixels look up where they lie in the backdrop by its depth,
/// and the pixels between them are interpolated; see Backdrop::errorOf() for the error. Copies if the camera is that
/// of the backdrop. Used for one frame; several threads may fill different rows at once.
class BackdropWarp {
 public:
  /// `withDepth`: parts of the frame that need depths, because something is laid over them. The backdrop outlives it.
  BackdropWarp(const Backdrop& backdrop, const world::Camera& frame, std::vector<world::Rect> withDepth);

  /// Fills all pixels of the rows; their depths elsewhere are undefined.
  void fill(FrameBuilder& rows) const;

 private:
  void copy(const world::Rect& rows, const FramePixels& out) const;
  /// Up to kWarpCells columns of cells.
  void warp(const world::Rect& strip, const FramePixels& out) const;
  [[nodiscard]] bool needsDepth(const world::Rect& part) const;

  const Backdrop& backdrop_;
  const CornerSearch search_;
  const world::Rect frame_;
  const bool still_;
  const std::vector<world::Rect> withDepth_;
};

}  // namespace grove::node
