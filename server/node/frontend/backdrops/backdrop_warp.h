#pragma once

#include "node/frontend/backdrops/backdrop.h"
#include "node/frontend/backdrops/backdrop_kernels.h"
#include "node/frontend/compositing/fresh_parts.h"
#include "node/messages/cell_nearness.h"
#include "raster/yuv_image.h"

namespace grove::node {

/// The frame that a backdrop is warped into.
struct WarpedFrame {
  raster::YuvImage& picture;
  raster::Image& layers;  ///< what is drawn over it
  CellNearness& nearness;
};

/// Shows a backdrop in a frame. Corners of cells of 8 x 8 pixels find their positions in the backdrop by its depth;
/// pixels between them are interpolated. See Backdrop::errorOf() for the error. Used for one frame; several threads may
/// fill different rows at once.
class BackdropWarp {
 public:
  /// The backdrop outlives it.
  BackdropWarp(const Backdrop& backdrop, const world::Camera& frame);

  /// Fills rows of the frame, from `top` on, a multiple of FreshParts::kStripHeight, to before `bottom`: all colours of
  /// the picture; where strips are fresh both colours and depths of the layers, elsewhere the nearness.
  void fill(int top, int bottom, const FreshParts& fresh, const WarpedFrame& out) const;

 private:
  /// One column of strips.
  void fillColumn(const world::Rect& column, const FreshParts& fresh, const WarpedFrame& out) const;
  void warpColours(const CornerLine& above, const CornerLine& below, const world::Rect& strip,
                   raster::YuvImage& picture) const;
  void warpDepth(const CornerLine& above, const CornerLine& below, const world::Rect& strip,
                 raster::Image& layers) const;
  void warpNearness(const CornerLine& above, const CornerLine& below, const world::Rect& strip,
                    CellNearness& nearness) const;

  const Backdrop& backdrop_;
  const CornerSearch search_;
  const WarpSource source_;
  const world::Rect frame_;
  const bool isCopy_;  ///< the backdrop's eye equals the frame's
};

}  // namespace grove::node
