// Pixels of a warped backdrop. For kernels: included once per target.

#if defined(GROVE_NODE_FRONTEND_BACKDROPS_WARP_PIXELS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef GROVE_NODE_FRONTEND_BACKDROPS_WARP_PIXELS_INL_H
#undef GROVE_NODE_FRONTEND_BACKDROPS_WARP_PIXELS_INL_H
#else
#define GROVE_NODE_FRONTEND_BACKDROPS_WARP_PIXELS_INL_H
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <cstdint>

#include "base/simd/channels_inl.h"
#include "base/simd/row_part_inl.h"
#include "node/frontend/backdrops/backdrop_kernels.h"

HWY_BEFORE_NAMESPACE();
namespace grove::node::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
namespace lanes = grove::simd::HWY_NAMESPACE;
using lanes::Channels;
using lanes::ChannelTag;
using lanes::Floats;
using lanes::Ints;
using lanes::kLanes;
using lanes::Mask;
using lanes::Neighbours;
using lanes::Pair;

/// The corners of one row of pixels.
struct RowCorners {
  float x[kCorners];
  float y[kCorners];
  float perForward[kCorners];

  HWY_INLINE RowCorners(const CornerLine& above, const CornerLine& below, int first, int last, float down) {
    const auto mix = [&](const float* __restrict from, const float* __restrict to, float* __restrict out) {
      for (int i = 0; i < last - first + 2; ++i) out[i] = from[first + i] + down * (to[first + i] - from[first + i]);
    };
    mix(above.x, below.x, x);
    mix(above.y, below.y, y);
    mix(above.perForward, below.perForward, perForward);
  }
};

/// Between the corners, for kLanes pixels from the `first` of the row on, which is the first of a cell or of its half.
HWY_INLINE Floats between(const float* corners, int first) {
  const int cell = first / 8;
  const Floats place = (lanes::toFloats((lanes::upwards() + first) & Ints(7)) + 0.5F) * 0.125F;
  const float begin = corners[cell];
  const float middle = corners[cell + 1];
  if constexpr (kLanes <= 8) {
    return lanes::mulAdd(place, Floats(middle - begin), Floats(begin));
  } else {
    const Mask isFirst = lanes::upwards() < Ints(8);
    const float end = corners[cell + 2];
    return lanes::mulAdd(place, lanes::select(isFirst, Floats(middle - begin), Floats(end - middle)),
                         lanes::select(isFirst, Floats(begin), Floats(middle)));
  }
}

HWY_INLINE Channels highBytes(Channels value) {
  return hn::AndNot(hn::Set(ChannelTag(), std::uint16_t{0x00FF}), value);
}

/// Four neighbouring pixels by shares of 256.
HWY_INLINE Ints blend(const Pair& above, const Pair& below, Ints right, Ints down) {
  const lanes::Bilinear weights(right, down);
  const Channels even = lanes::whole(weights.sumOf<0>(above, below));
  const Channels odd = lanes::rounded(weights.sumOf<8>(above, below));
  return Ints(hn::BitCast(lanes::IntTag(), hn::Or(even, highBytes(odd))));
}

/// The columns and rows that kLanes pixels have, as their corners say.
struct Span {
  int left, right, top, bottom;

  HWY_INLINE Span(const WarpSource& source, const RowCorners& corners, int first)
      : Span(source, corners, first / 8, (first + kLanes - 1) / 8 + 1) {}

 private:
  HWY_INLINE Span(const WarpSource& source, const RowCorners& corners, int begin, int end) {
    float lowX = corners.x[begin];
    float highX = lowX;
    float lowY = corners.y[begin];
    float highY = lowY;
    for (int i = begin + 1; i <= end; ++i) {
      lowX = std::min(lowX, corners.x[i]);
      highX = std::max(highX, corners.x[i]);
      lowY = std::min(lowY, corners.y[i]);
      highY = std::max(highY, corners.y[i]);
    }
    const auto place = [](float value, int size) {
      return static_cast<int>(std::clamp(value - 0.5F, 0.0F, static_cast<float>(size - 2)));
    };
    left = place(lowX, source.width);
    right = place(highX, source.width);
    top = place(lowY, source.height);
    bottom = place(highY, source.height);
  }
};

#if GROVE_SIMD_PERMUTES
/// Neighbouring pixels of a frame lie between neighbouring pixels of the backdrop: two registers of three rows hold all
/// of them, unless the picture is turned or made smaller. False if they do not.
HWY_INLINE bool lookUpNear(const WarpSource& source, const Span& span, Ints column, Ints row, Neighbours& out) {
  if (span.right - span.left > 2 * kLanes - 2 || span.bottom - span.top > 1) return false;
  const std::ptrdiff_t begin = std::ptrdiff_t{span.top} * source.width + span.left;
  const std::ptrdiff_t third = 2 * std::ptrdiff_t{source.width};
  if (begin + third + 2 * kLanes > std::ptrdiff_t{source.width} * source.height) return false;
  const Ints right = column - Ints(span.left);
  const std::uint32_t* const colour = source.colour + begin;
  out = {lanes::pairAt(colour, right), lanes::pairAt(colour + source.width, right)};
  if (span.bottom == span.top) return true;
  const Mask isLower = row > Ints(span.top);
  out = {lanes::select(isLower, out.below, out.above),
         lanes::select(isLower, lanes::pairAt(colour + third, right), out.below)};
  return true;
}
#else
HWY_INLINE bool lookUpNear(const WarpSource&, const Span&, Ints, Ints, Neighbours&) { return false; }
#endif

/// Colours of kLanes pixels from the `first` of a row on.
HWY_INLINE void warpPixels(const WarpSource& source, const RowCorners& corners, int first, std::uint32_t* colour) {
  const Floats x = lanes::clamp(between(corners.x, first) - 0.5F, 0.0F, static_cast<float>(source.width - 2));
  const Floats y = lanes::clamp(between(corners.y, first) - 0.5F, 0.0F, static_cast<float>(source.height - 2));
  const Ints column = lanes::truncate(x);
  const Ints row = lanes::truncate(y);
  const Ints right = lanes::truncate(lanes::mulAdd(x - lanes::toFloats(column), 256.0F, 0.5F));
  const Ints down = lanes::truncate(lanes::mulAdd(y - lanes::toFloats(row), 256.0F, 0.5F));
  const Span span(source, corners, first);
  Neighbours near;
  if (!lookUpNear(source, span, column, row, near))
    near = lanes::lookUpNeighbours(source.colour, source.width, column, row);
  lanes::store(blend(near.above, near.below, right, down), colour);
}

}  // namespace grove::node::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // once per target
