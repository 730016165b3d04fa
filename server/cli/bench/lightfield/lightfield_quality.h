#pragma once

#include "objects/lightfield/backend/sampler.h"

namespace grove::cli {

/// Quality of a sampler against a light field's held-out views, inside the object's mask. Errors are pooled over all
/// views: the PSNR is that of the mean square error.
struct LightfieldQuality {
  double psnr = 0.0;  ///< dB, of the premultiplied colours
  double ssim = 0.0;  ///< mean over the views
  /// dB, composited over a bright sky: the coverage then counts fully, which premultiplied colours of dark leaves
  /// hardly show.
  double psnrOverSky = 0.0;
  /// Of tiles among their neighbours, dB: within 0.1 m of the border between two, and inside.
  double seamPsnr = 0.0;
  double insidePsnr = 0.0;
};

[[nodiscard]] LightfieldQuality measureQuality(const objects::lightfield::LightField& field,
                                               objects::lightfield::DepthCorrection correction);

}  // namespace grove::cli
