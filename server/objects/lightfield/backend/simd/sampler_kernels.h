#pragma once

#include "objects/lightfield/backend/sampler.h"

namespace grove::objects::lightfield::simd {

/// Makes one picture of a light field, see SimdSampler.
void renderPicture(const SampleRequest& request, DepthCorrection correction, raster::Image& image);

}  // namespace grove::objects::lightfield::simd
