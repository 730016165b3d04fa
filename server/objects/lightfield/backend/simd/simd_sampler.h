#pragma once

#include "objects/lightfield/backend/sampler.h"

namespace grove::objects::lightfield {

/// The Sampler for machines without a GPU: loops over tiles of pixels, vectors of them at a time.
///
/// How a pixel is made (section 5.1, Figure 5.4 right):
/// 1. Its ray is cut by the object's bounds.
/// 2. The ray's line enters the sphere of views, behind the eye if need be; a place below the rim is moved up to it.
///    The lattice cell of that direction gives the four nearest views and their bilinear weights.
/// 3. The ray is walked from near to far as the heaviest view sees it, from texel to texel along the axis that its line
///    mostly follows, looking at the two texels beside the line at each. A texel is met by the bilinear weight that it
///    has for the ray's point at that texel's depth; the ray ends where the weights of one step and the one before add
///    up to more than 0.35, at their mean place. If they never do, the place with the largest sum is taken, for the
///    silhouette. A ray that passed behind something is not settled by that: the next heaviest view looks at the part
///    that was hidden. If it remains so for more than a third, the point is taken to lie in the middle of that part.
/// 4. The point is projected into each of the four views. Of the four texels around it those that are nearer than it by
///    more than 7 texels' widths hide it and are left out; the others count by the bilinear weight times the view's,
///    those that show nothing too, which gives smooth silhouettes and lets a view that sees through the point have its
///    say. The sum is divided by the weights that counted. For points that remained hidden all texels count.
///
/// Views are read through windows (simd/texel_window.h): what a tile can see of a view is copied to where it can be
/// read densely. The depths found there also bound the walks, most of which are short for that.
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
