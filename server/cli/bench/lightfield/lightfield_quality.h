#pragma once

#include "objects/lightfield/backend/sampler.h"

namespace grove::cli {

/// How close a sampler comes to a light field's held-out views, inside the object's mask. Errors are pooled over all
/// views: the PSNR is that of the mean square error.
struct LightfieldQuality {
  double psnr = 0.0;  ///< dB, of the premultiplied colours
  double ssim = 0.0;  ///< mean of the views'
  /// dB, laid over a bright sky: coverage counts in full, which the premultiplied colours of dark leaves hardly show.
  double psnrOverSky = 0.0;
  /// Of tiles amid their neighbours, dB: within a hand's breadth of the border between two, and inside.
  double seamPsnr = 0.0;
  double insidePsnr = 0.0;
};

[[nodiscard]] LightfieldQuality measureQuality(const objects::lightfield::LightField& field,
                                               objects::lightfield::DepthCorrection correction);

}  // namespace grove::cli
