#pragma once

#include <span>

#include "objects/lightfield/common/haze.h"
#include "objects/lightfield/format/light_field.h"
#include "raster/image.h"

namespace grove::objects::lightfield {

/// A picture of a light field to make.
struct SampleRequest {
  const LightField* field = nullptr;
  int lighting = 0;
  int level = 0;        ///< of the mip pyramid
  ObjectCamera camera;  ///< of the whole frame
  Haze haze;
};

/// The rendering node's stage for light fields (section 5.1): each pixel of `image.rect` has a ray that meets the
/// sphere of views. The sampler finds, by depth, the texels of the four nearest views that show the same point as the
/// ray, and interpolates 4 views x 4 texels of colour and depth.
///
/// Fills the whole image with colour and depth (kInfiniteDepth where nothing is visible).
class Sampler {
 public:
  virtual ~Sampler() = default;
  virtual void render(std::span<const SampleRequest> requests, std::span<raster::Image* const> images) = 0;
};

/// The uncorrected blend of the paper's Figure 5.4, left: like render(), but without depth. Used to measure the gain
/// from depth.
enum class DepthCorrection { kOn, kOff };

}  // namespace grove::objects::lightfield
