#pragma once

#include "objects/lightfield/backend/sampler.h"

namespace grove::objects::lightfield {

/// The Sampler for machines without a GPU: loops over tiles of pixels, one vector of them at a time.
///
/// Steps for each pixel (section 5.1, Figure 5.4 right):
/// 1. Its ray is clipped to the object's bounds.
/// 2. The ray's line enters the sphere of views, behind the eye if necessary; a point below the rim is moved up to it.
///    The lattice cell of that direction gives the four nearest views and their bilinear weights.
/// 3. The ray is marched from near to far in the heaviest view, from texel to texel along the dominant axis of its
/// line,
///    testing the two texels beside the line at each step. A texel counts with its bilinear weight for the ray's point
///    at that texel's depth; the ray ends where the weights of two successive steps add up to more than 0.35, at their
///    mean place. If they never do, the place with the largest sum is used, for the silhouette. A ray that passed
///    behind something is not settled yet: the next heaviest view searches the hidden part. If more than a third of the
///    ray remains hidden, its point is assumed to lie in the middle of the hidden part.
/// 4. The point is projected into each of the four views. Of the four texels around it, those that are nearer than the
///    point by more than 7 widths of a texel hide it and are skipped. The others count with the bilinear weight times
///    the view's weight, including empty texels: they smooth silhouettes, and views that see through the point
///    contribute. The sum is divided by the weights that counted. For points that remained hidden all texels count.
///
/// Views are read through windows (simd/texel_window.h): the part of a view that a tile can see is copied to dense
/// memory. The depths found there also bound the marches, which keeps most of them short.
///
/// Any number of threads may render at once.
class SimdSampler final : public Sampler {
 public:
  explicit SimdSampler(DepthCorrection correction = DepthCorrection::kOn) noexcept : correction_(correction) {}

  void render(std::span<const SampleRequest> requests, std::span<raster::Image* const> images) override;

 private:
  DepthCorrection correction_;
};

}  // namespace grove::objects::lightfield
