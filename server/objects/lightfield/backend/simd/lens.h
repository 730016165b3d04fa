#pragma once

#include <array>
#include <cstddef>

#include "objects/lightfield/format/light_field.h"

namespace grove::objects::lightfield::simd {

/// A view's camera at one level, in the form that the loops need: for p = point - eye, the view depth is z =
/// dot(forward, p) and the texel column is dot(column, p) / z + middle; texel centres are at whole numbers.
struct Lens {
  int view = -1;
  world::Vec3 eye{0.0F};
  world::Vec3 column{0.0F};
  world::Vec3 row{0.0F};
  world::Vec3 forward{0.0F};
  float middle = 0.0F;
  float nearDepth = 0.0F;       ///< view depth of stored depth 0, metres
  float depthStep = 0.0F;       ///< metres per step of stored depth
  float metresPerTexel = 0.0F;  ///< at one metre
};

inline Lens makeLens(const LightField& field, int level, int view) {
  const ViewCamera camera = viewCamera(field.geometry, field.sphere.direction(view));
  const float size = static_cast<float>(field.size >> level);
  Lens lens;
  lens.view = view;
  lens.eye = camera.eye;
  lens.column = camera.right * (camera.focal * size);
  lens.row = camera.down * (camera.focal * size);
  lens.forward = camera.forward;
  lens.middle = 0.5F * size - 0.5F;
  lens.nearDepth = camera.nearDepth;
  lens.depthStep = (camera.farDepth - camera.nearDepth) / 65534.0F;
  lens.metresPerTexel = 1.0F / (camera.focal * size);
  return lens;
}

/// A request's lenses, computed on first use. Not thread-safe.
class Lenses {
 public:
  Lenses(const LightField& field, int level) : field_(field), level_(level) {}
  [[nodiscard]] const Lens& of(int view) {
    Lens& lens = recent_[static_cast<std::size_t>(view) % recent_.size()];
    if (lens.view != view) lens = makeLens(field_, level_, view);
    return lens;
  }

 private:
  const LightField& field_;
  int level_;
  std::array<Lens, 61> recent_;
};

}  // namespace grove::objects::lightfield::simd
