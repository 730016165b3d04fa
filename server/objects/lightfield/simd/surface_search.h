#pragma once

#include "objects/lightfield/simd/texel_window.h"
#include "objects/lightfield/simd/tile.h"

namespace grove::objects::lightfield::simd {

/// Finds the point of the object that each pixel shows, by walking along its ray as a nearby view sees it.
class SurfaceSearch {
 public:
  SurfaceSearch(const LightField& field, int level, Lenses& lenses) : field_(field), level_(level), lenses_(lenses) {}

  /// Fills the tile's depth and found.
  void run(Tile& tile);

 private:
  /// Walks in `view` with the masked pixels; what is found there is taken out of the mask, and what is certainly not
  /// there too. Left are rays that passed behind something.
  void walk(Tile& tile, int view, Plane<Ints>& mask);

  const LightField& field_;
  const int level_;
  Lenses& lenses_;
  NearnessWindow window_;
};

}  // namespace grove::objects::lightfield::simd
