#pragma once

#include "objects/lightfield/simd/tile.h"

namespace grove::objects::lightfield::simd {

/// Sums over the views; premultiplied bytes and their weight.
struct Blended {
  Plane<Floats> red, green, blue, coverage, weight;
};

/// Interpolates the four nearest views of each pixel where they see its point, 4 texels of colour and depth each.
class Blend {
 public:
  Blend(const LightField& field, int level, int lighting, Lenses& lenses)
      : field_(field), level_(level), lighting_(lighting), lenses_(lenses) {}

  /// Only where the tile's found is set. Where guessed is set too, without regard to depth.
  [[nodiscard]] const Blended& run(const Tile& tile);

 private:
  /// Adds one view, which lies at `point` in the lattice.
  void add(const Tile& tile, ViewSphere::Point point);

  const LightField& field_;
  const int level_;
  const int lighting_;
  Lenses& lenses_;
  TexelWindow window_;
  Blended sum_;
};

}  // namespace grove::objects::lightfield::simd
