#pragma once

#include <span>

#include "objects/lightfield/common/haze.h"
#include "objects/lightfield/format/light_field.h"
#include "raster/image.h"

namespace grove::objects::lightfield {

/// One picture to make of a light field.
struct SampleRequest {
  const LightField* field = nullptr;
  int lighting = 0;
  int level = 0;        ///< of the mip pyramid
  ObjectCamera camera;  ///< of the whole frame
  Haze haze;
};

/// The rendering node's stage for light fields (section 5.1): for each pixel of `image.rect` the ray meets the sphere
/// of views, and the texels of the four nearest views that show the same point as the ray (found by their depth) are
/// interpolated, 4 views x 4 texels for colour and depth.
///
/// Fills all of the image's colour and depth (kInfiniteDepth where there is nothing).
class Sampler {
 public:
  virtual ~Sampler() = default;
  virtual void render(std::span<const SampleRequest> requests, std::span<raster::Image* const> images) = 0;
};

/// The uncorrected blend of the paper's Figure 5.4, left: as render(), but without using depth; it is there to measure
/// what depth gains.
enum class DepthCorrection { kOn, kOff };

}  // namespace grove::objects::lightfield
