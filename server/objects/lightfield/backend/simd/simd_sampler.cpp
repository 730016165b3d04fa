#include "objects/lightfield/backend/simd/simd_sampler.h"

#include <cassert>

#include "objects/lightfield/backend/simd/sampler_kernels.h"

namespace grove::objects::lightfield {

void SimdSampler::render(std::span<const SampleRequest> requests, std::span<raster::Image* const> images) {
  assert(requests.size() == images.size());
  for (std::size_t i = 0; i < requests.size(); ++i) simd::renderPicture(requests[i], correction_, *images[i]);
}

}  // namespace grove::objects::lightfield
