#include "stream/encode/h264/prediction/intra_fit_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "stream/encode/h264/prediction/intra_fit_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "stream/encode/h264/prediction/difference_inl.h"

HWY_BEFORE_NAMESPACE();
namespace grove::stream::h264::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// Where the mean is farther than another prediction by this factor, no mode will be nearer than that one.
constexpr int kHopeless = 3;

/// A row of a macroblock.
using Bytes = hn::FixedTag<std::uint8_t, 16>;
using ByteVec = hn::Vec<Bytes>;
using Difference = DifferenceSum<Bytes>;

HWY_INLINE ByteVec rowOf(const MacroblockPixels& source, int y) {
  return hn::Load(Bytes(), source.luma.data() + y * MacroblockPixels::kStride);
}

/// The pixels around a macroblock.
struct Around {
  HWY_ALIGN std::uint8_t above[16];
  HWY_ALIGN std::uint8_t left[16];
  int corner;

  HWY_INLINE Around(const BorderedPlane& plane, int x, int y) : corner(*plane.at(x - 1, y - 1)) {
    hn::Store(hn::LoadU(Bytes(), plane.at(x, y - 1)), Bytes(), above);
    for (int i = 0; i < 16; ++i) left[i] = *plane.at(x - 1, y + i);
  }
};

HWY_INLINE int sumOf(const std::uint8_t* line) {
  const hn::Repartition<std::uint64_t, Bytes> sums;
  return static_cast<int>(hn::GetLane(hn::SumOfLanes(sums, hn::SumsOf8(hn::Load(Bytes(), line)))));
}

HWY_INLINE int meanOf(const Around& around, bool hasLeft, bool hasAbove) {
  if (hasLeft && hasAbove) return (sumOf(around.left) + sumOf(around.above) + 16) >> 5;
  if (hasLeft) return (sumOf(around.left) + 8) >> 4;
  return hasAbove ? (sumOf(around.above) + 8) >> 4 : 128;
}

/// Section 8.3.3.4.
HWY_INLINE int slopeOf(const std::uint8_t* line, int corner) {
  int sum = 8 * (line[15] - corner);
  for (int i = 1; i < 8; ++i) sum += i * (line[7 + i] - line[7 - i]);
  return (5 * sum + 32) >> 6;
}

/// `predicted` returns a row.
template <class Predicted>
HWY_INLINE int rowsDifference(const MacroblockPixels& source, const Predicted& predicted) {
  Difference difference;
  for (int y = 0; y < kMacroblock; ++y) difference.add(rowOf(source, y), predicted(y));
  return difference.total();
}

HWY_INLINE int planeDifference(const Around& around, const MacroblockPixels& source) {
  using Words = hn::CappedTag<std::int16_t, 16>;
  using Part = hn::Rebind<std::uint8_t, Words>;
  constexpr int kLanes = static_cast<int>(hn::MaxLanes(Words()));
  const auto every = [](int value) { return hn::Set(Words(), static_cast<std::int16_t>(value)); };
  const int across = slopeOf(around.above, around.corner);
  const int down = slopeOf(around.left, around.corner);
  const int first = 16 * (around.left[15] + around.above[15]) - 7 * (across + down) + 16;
  const auto left = hn::Add(every(first), hn::Mul(hn::Iota(Words(), 0), every(across)));
  HWY_ALIGN std::uint8_t row[16];
  return rowsDifference(source, [&](int y) {
    for (int x = 0; x < kMacroblock; x += kLanes) {
      const auto sum = hn::Add(left, every(down * y + across * x));
      hn::Store(hn::DemoteTo(Part(), hn::ShiftRight<5>(sum)), Part(), row + x);
    }
    return hn::Load(Bytes(), row);
  });
}

IntraFit bestIntraLuma(const ReferencePicture& picture, int column, int row, const MacroblockPixels& source,
                       int enough) {
  const Around around(picture.plane(0), column * kMacroblock, row * kMacroblock);
  const bool hasLeft = column > 0;
  const bool hasAbove = row > 0;
  const ByteVec mean = hn::Set(Bytes(), static_cast<std::uint8_t>(meanOf(around, hasLeft, hasAbove)));
  IntraFit best{IntraMode::kMean, rowsDifference(source, [&](int) { return mean; })};
  if (best.difference / kHopeless > enough) return best;
  const auto tryMode = [&](IntraMode mode, int difference) {
    if (difference < best.difference) best = {mode, difference};
  };
  const ByteVec above = hn::Load(Bytes(), around.above);
  if (hasAbove) tryMode(IntraMode::kVertical, rowsDifference(source, [&](int) { return above; }));
  if (hasLeft) {
    tryMode(IntraMode::kHorizontal, rowsDifference(source, [&](int y) { return hn::Set(Bytes(), around.left[y]); }));
  }
  if (hasLeft && hasAbove) tryMode(IntraMode::kPlane, planeDifference(around, source));
  return best;
}

}  // namespace grove::stream::h264::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace grove::stream::h264 {

HWY_EXPORT(bestIntraLuma);

IntraFit bestIntraLuma(const ReferencePicture& picture, int column, int row, const MacroblockPixels& source,
                       int enough) {
  return HWY_DYNAMIC_DISPATCH(bestIntraLuma)(picture, column, row, source, enough);
}

}  // namespace grove::stream::h264

#endif  // HWY_ONCE
