#pragma once

#include <functional>
#include <span>
#include <stop_token>
#include <vector>

#include "objects/lightfield/bake/light/light_points.h"
#include "objects/lightfield/bake/light/lightings.h"
#include "objects/lightfield/bake/model_rays.h"

namespace grove::bake {

/// The light that arrives at each light point, per side and lighting: linear, as the radiance that a white surface
/// would reflect (the convention of world/sky.h).
class SurfaceLight {
 public:
  SurfaceLight(std::size_t points, int lightings)
      : stride_(static_cast<std::size_t>(lightings) * 3), values_(points * 2 * stride_) {}

  /// Floats of one side: R, G, B of each lighting.
  [[nodiscard]] std::size_t stride() const noexcept { return stride_; }
  /// The front's floats, then the back's.
  [[nodiscard]] std::span<float> at(std::size_t point) noexcept { return {&values_[point * 2 * stride_], 2 * stride_}; }
  [[nodiscard]] std::span<const float> at(std::size_t point) const noexcept {
    return {&values_[point * 2 * stride_], 2 * stride_};
  }

 private:
  std::size_t stride_;
  std::vector<float> values_;
};

struct LightSettings {
  int threads = 1;
  float away = 0.01F;     ///< offset of ray origins from the surface in metres, against self-intersection
  bool grounded = false;  ///< the model has its own ground; else a meadow lies at y = 0
  int directions = 64;    ///< per point, over the whole sphere; about half are in front of a surface
  int sunRays = 8;        ///< even; towards each lighting's sun
};

/// Computes the light of the sun (a small disc) and of the sky through the model's gaps, from the meadow below, through
/// leaves, and two bounces between surfaces. Unoccluded surfaces get exactly ambient() plus the sun.
///
/// A tile's surrounding copies block no light: shadows of other objects are computed where an object stands, and tiles
/// show their sides where their group ends.
///
/// All points use the same directions: this avoids noise, and rays of neighbouring points form coherent packets. The
/// result does not depend on the number of threads, and is incomplete if `stop` was requested. `progress` gets the
/// completed share, from any thread, one at a time.
[[nodiscard]] SurfaceLight lightSurfaces(const models::Model& model, const LightPoints& points, const ModelRays& rays,
                                         const Lightings& lightings, const LightSettings& settings,
                                         const std::function<void(float)>& progress, const std::stop_token& stop);

}  // namespace grove::bake
