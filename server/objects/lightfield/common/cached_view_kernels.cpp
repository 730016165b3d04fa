#include "objects/lightfield/common/cached_view_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "objects/lightfield/common/cached_view_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "objects/lightfield/common/lower_upper_inl.h"

HWY_BEFORE_NAMESPACE();
namespace grove::objects::lightfield::HWY_NAMESPACE {

CoveredSpan coveredSpan(const std::uint32_t* __restrict colour, const float* __restrict depth, int width) {
  int first = width;
  int end = 0;
  float nearest = world::kInfiniteDepth;
  for (int x = 0; x < width; ++x) {
    const bool covered = showsAnything(colour[x], depth[x]);
    const int begins = covered ? x : width;
    const int ends = covered ? x + 1 : 0;
    const float away = covered ? depth[x] : world::kInfiniteDepth;
    first = begins < first ? begins : first;
    end = ends > end ? ends : end;
    nearest = lower(nearest, away);
  }
  return {first, end, nearest};
}

void widenRow(const float* __restrict near, int width, float* __restrict wide) {
  for (int x = 1; x < width - 1; ++x) wide[x] = upper(upper(near[x - 1], near[x]), near[x + 1]);
}

void rankRow(const float* __restrict above, const float* __restrict here, const float* __restrict below,
             const std::uint32_t* __restrict colour, int width, float softness, float* __restrict nearness) {
  for (int x = 0; x < width; ++x) {
    const float around = upper(upper(above[x], here[x]), below[x]);
    const float own = nearness[x] > 0.0F ? nearness[x] : around;
    nearness[x] = colour[x] >> 24U >= 128U ? own : own - softness;
  }
}

void widenRanges(const float* __restrict nearness, int width, float softness, float* __restrict min,
                 float* __restrict max) {
  for (int x = 0; x < width; ++x) {
    const float near = nearness[x] < 0.0F ? nearness[x] + softness : nearness[x];
    min[x] = near > 0.0F ? lower(min[x], near) : min[x];
    max[x] = upper(max[x], near);
  }
}

}  // namespace grove::objects::lightfield::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace grove::objects::lightfield {

HWY_EXPORT(coveredSpan);
HWY_EXPORT(widenRow);
HWY_EXPORT(rankRow);
HWY_EXPORT(widenRanges);

CoveredSpan coveredSpan(const std::uint32_t* colour, const float* depth, int width) {
  return HWY_DYNAMIC_DISPATCH(coveredSpan)(colour, depth, width);
}

void widenRow(const float* near, int width, float* wide) { HWY_DYNAMIC_DISPATCH(widenRow)(near, width, wide); }

void rankRow(const float* above, const float* here, const float* below, const std::uint32_t* colour, int width,
             float softness, float* nearness) {
  HWY_DYNAMIC_DISPATCH(rankRow)(above, here, below, colour, width, softness, nearness);
}

void widenRanges(const float* nearness, int width, float softness, float* min, float* max) {
  HWY_DYNAMIC_DISPATCH(widenRanges)(nearness, width, softness, min, max);
}

}  // namespace grove::objects::lightfield

#endif  // HWY_ONCE
