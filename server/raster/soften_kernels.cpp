#include "raster/soften_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "raster/soften_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace grove::raster::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using PixelTag = hn::CappedTag<std::uint32_t, 16>;
using ByteTag = hn::Repartition<std::uint8_t, PixelTag>;
using Bytes = hn::Vec<ByteTag>;
constexpr int kPixels = static_cast<int>(hn::MaxLanes(PixelTag()));

/// Rounds down; hn::AverageRound() rounds up. Both in turn keep the mean.
HWY_INLINE Bytes averageDown(Bytes a, Bytes b) {
  const ByteTag tag;
  const Bytes halves = hn::And(hn::BitCast(tag, hn::ShiftRight<1>(hn::BitCast(PixelTag(), hn::Xor(a, b)))),
                               hn::Set(tag, std::uint8_t{0x7F}));
  return hn::Add(hn::And(a, b), halves);
}

HWY_INLINE Bytes softened(Bytes before, Bytes here, Bytes after, Softening softening) {
  const Bytes half = hn::AverageRound(averageDown(before, after), here);
  return softening == Softening::kHalf ? half : averageDown(half, here);
}

HWY_INLINE Bytes pixelsAt(const std::uint32_t* from) { return hn::BitCast(ByteTag(), hn::LoadU(PixelTag(), from)); }

/// For `count` pixels, whose neighbours are in other rows or in the same.
HWY_INLINE void softenRow(const std::uint32_t* before, const std::uint32_t* here, const std::uint32_t* after, int count,
                          Softening softening, std::uint32_t* out) {
  int x = 0;
  for (; x + kPixels <= count; x += kPixels) {
    const Bytes pixels = softened(pixelsAt(before + x), pixelsAt(here + x), pixelsAt(after + x), softening);
    hn::StoreU(hn::BitCast(PixelTag(), pixels), PixelTag(), out + x);
  }
  const auto one = [](const std::uint32_t* from) { return hn::BitCast(ByteTag(), hn::Set(PixelTag(), *from)); };
  for (; x < count; ++x) {
    out[x] = hn::GetLane(hn::BitCast(PixelTag(), softened(one(before + x), one(here + x), one(after + x), softening)));
  }
}

void softenDown(const std::uint32_t* above, const std::uint32_t* here, const std::uint32_t* below, int width,
                Softening softening, std::uint32_t* out) {
  softenRow(above, here, below, width, softening, out);
}

void softenAcross(const std::uint32_t* row, int width, Softening softening, std::uint32_t* out) {
  if (width < 1) return;
  const std::uint32_t* const end = row + width - 1;
  const int inner = width - 2;
  softenRow(row, row, width > 1 ? row + 1 : row, 1, softening, out);
  if (inner > 0) softenRow(row, row + 1, row + 2, inner, softening, out + 1);
  if (width > 1) softenRow(end - 1, end, end, 1, softening, out + width - 1);
}

HWY_INLINE float lower(float a, float b) { return a < b ? a : b; }

void nearestAcross(const float* __restrict depth, int width, float* __restrict out) {
  for (int x = 1; x < width - 1; ++x) out[x] = lower(lower(depth[x - 1], depth[x]), depth[x + 1]);
  const int last = width - 1;
  out[0] = lower(depth[0], depth[last < 1 ? last : 1]);
  out[last] = lower(depth[last], depth[last < 1 ? 0 : last - 1]);
}

void deepenFringe(const float* __restrict above, const float* __restrict here, const float* __restrict below,
                  const std::uint32_t* __restrict colour, int width, float* __restrict depth) {
  for (int x = 0; x < width; ++x) {
    const float around = lower(lower(above[x], here[x]), below[x]);
    const bool isFringe = (depth[x] >= world::kInfiniteDepth) & (colour[x] >> 24U != 0);
    depth[x] = isFringe ? around : depth[x];
  }
}

}  // namespace
}  // namespace grove::raster::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace grove::raster {

HWY_EXPORT(softenDown);
HWY_EXPORT(softenAcross);
HWY_EXPORT(nearestAcross);
HWY_EXPORT(deepenFringe);

void softenDown(const std::uint32_t* above, const std::uint32_t* here, const std::uint32_t* below, int width,
                Softening softening, std::uint32_t* out) {
  HWY_DYNAMIC_DISPATCH(softenDown)(above, here, below, width, softening, out);
}

void softenAcross(const std::uint32_t* row, int width, Softening softening, std::uint32_t* out) {
  HWY_DYNAMIC_DISPATCH(softenAcross)(row, width, softening, out);
}

void nearestAcross(const float* depth, int width, float* out) {
  HWY_DYNAMIC_DISPATCH(nearestAcross)(depth, width, out);
}

void deepenFringe(const float* above, const float* here, const float* below, const std::uint32_t* colour, int width,
                  float* depth) {
  HWY_DYNAMIC_DISPATCH(deepenFringe)(above, here, below, colour, width, depth);
}

}  // namespace grove::raster

#endif  // HWY_ONCE
