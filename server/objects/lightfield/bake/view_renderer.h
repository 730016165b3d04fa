#pragma once

#include <cstdint>
#include <vector>

#include "objects/lightfield/bake/light/light_points.h"
#include "objects/lightfield/bake/light/surface_light.h"
#include "objects/lightfield/bake/model_rays.h"
#include "objects/lightfield/format/view_camera.h"

namespace grove::bake {

/// A rendered picture, rows from the top.
struct Picture {
  int size = 0;
  std::vector<std::vector<std::uint32_t>> colour;  ///< by lighting; as in LightField
  std::vector<float> depth;                        ///< view depth, world::kInfiniteDepth where nothing is
};

/// Renders pictures of a lit model with samples x samples primary rays per pixel. Immutable; any number of threads.
///
/// A pixel's colour is the mean of its samples *as displayed*, weighted by coverage: light-field samplers and mips
/// interpolate displayed colours, so that their interpolation between pixels, angles and sizes tends to the same mean.
/// Its depth is the depth of the surface that most covered samples hit (the nearest, if several have as many), never a
/// mix of two surfaces, which would lie in empty space.
class ViewRenderer {
 public:
  /// Keeps references to all of them.
  ViewRenderer(const models::Model& model, const std::vector<TextureSampler>& textures, const ModelRays& rays,
               const LightPoints& points, const SurfaceLight& light, int samples);

  [[nodiscard]] Picture render(const objects::lightfield::ObjectCamera& camera, int size,
                               ModelRays::Among among = ModelRays::Among::kModel) const;

 private:
  struct Gathered;

  void gather(const objects::lightfield::ObjectCamera& camera, int left, int top, ModelRays::Among among,
              Gathered& block) const;
  void shade(const RTCRayHit16& rays, std::size_t lane, float footprint, float* colour) const;

  const models::Model& model_;
  const std::vector<TextureSampler>& textures_;
  const ModelRays& rays_;
  const LightPoints& points_;
  const SurfaceLight& light_;
  const int samples_;
  std::vector<float> display_;         ///< world::toDisplay() * 255 by the leading bits of a float
  std::vector<float> texelsPerMetre_;  ///< of a triangle's texture; empty without textures
};

}  // namespace grove::bake
