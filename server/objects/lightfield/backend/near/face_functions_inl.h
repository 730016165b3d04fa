// A face's values at the pixels of a tile: covered samples, nearness, colour, and spans of pixels. Only for exact
// kernels (GroveTargets.cmake).

#if defined(GROVE_OBJECTS_LIGHTFIELD_BACKEND_NEAR_FACE_FUNCTIONS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef GROVE_OBJECTS_LIGHTFIELD_BACKEND_NEAR_FACE_FUNCTIONS_INL_H
#undef GROVE_OBJECTS_LIGHTFIELD_BACKEND_NEAR_FACE_FUNCTIONS_INL_H
#else
#define GROVE_OBJECTS_LIGHTFIELD_BACKEND_NEAR_FACE_FUNCTIONS_INL_H
#endif

#include <hwy/highway.h>

#include <cstddef>
#include <cstdint>

#include "objects/lightfield/backend/near/face_batch_inl.h"

HWY_BEFORE_NAMESPACE();
namespace grove::objects::lightfield::HWY_NAMESPACE {

// A step is eight columns and as many rows as fit a vector, since most faces are narrow.
using Words = hn::CappedTag<std::int16_t, NearPixels::kCount>;
using Masks = hn::RebindToUnsigned<Words>;
using Bytes = hn::Repartition<std::uint8_t, Words>;
using Floats = hn::Repartition<float, Words>;
using Ints = hn::RebindToSigned<Floats>;
using WordVec = hn::Vec<Words>;
using MaskVec = hn::Vec<Masks>;
using FloatVec = hn::Vec<Floats>;
constexpr std::size_t kStep = hn::MaxLanes(Words());
constexpr int kStepRows = static_cast<int>(kStep) / NearPixels::kColumns;

/// Rounds to 16-bit integers, stored in the low half of each 32-bit lane. Larger values are clamped.
HWY_INLINE hn::Vec<Ints> rounded(FloatVec values) {
  // Adding 1.5 * 2^23 moves the rounded integer into the lowest bits.
  constexpr float kWhole = 12582912.0F;
  const Floats tag;
  const auto limited = hn::Min(hn::Max(values, hn::Set(tag, -32767.0F)), hn::Set(tag, 32767.0F));
  return hn::BitCast(Ints(), hn::Add(limited, hn::Set(tag, kWhole)));
}

/// Copies the low half of lane kIndex of each 128 bits to all eight pixels of that row.
template <int kIndex>
HWY_INLINE WordVec broadcast(hn::Vec<Ints> values) {
  constexpr std::uint8_t kLow = 4 * kIndex;
  constexpr std::uint8_t kHigh = kLow + 1;
  alignas(16) static constexpr std::uint8_t kBytes[16] = {kLow, kHigh, kLow, kHigh, kLow, kHigh, kLow, kHigh,
                                                          kLow, kHigh, kLow, kHigh, kLow, kHigh, kLow, kHigh};
  const Bytes bytes;
  return hn::BitCast(Words(), hn::TableLookupBytes(hn::BitCast(bytes, values), hn::LoadDup128(bytes, kBytes)));
}

/// Evaluates four linear functions of a face at the pixels of a step.
class Planes {
 public:
  HWY_INLINE Planes(const LinearFunctions& functions, std::size_t face)
      : first_(hn::LoadDup128(Floats(), functions.first[face])),
        perColumn_(hn::LoadDup128(Floats(), functions.perColumn[face])),
        perRow_(hn::LoadDup128(Floats(), functions.perRow[face])) {
    const auto perPixel = rounded(perColumn_);
    const WordVec lane = hn::And(hn::Iota(Words(), 0), hn::Set(Words(), NearPixels::kColumns - 1));
    lanes_[0] = hn::Mul(broadcast<0>(perPixel), lane);
    lanes_[1] = hn::Mul(broadcast<1>(perPixel), lane);
    lanes_[2] = hn::Mul(broadcast<2>(perPixel), lane);
    lanes_[3] = hn::Mul(broadcast<3>(perPixel), lane);
  }

  /// Returns the four values at the first pixel of each row. Two faces with a common edge get the same values.
  HWY_INLINE hn::Vec<Ints> at(int column, int row) const {
    const Floats tag;
    const auto rowOfLane = hn::Add(hn::Set(tag, static_cast<float>(row)), hn::LoadU(tag, kRowOfLane));
    return rounded(
        hn::MulAdd(perRow_, rowOfLane, hn::MulAdd(perColumn_, hn::Set(tag, static_cast<float>(column)), first_)));
  }

  /// Returns one function at all pixels of the step, given the result of at().
  template <int kFunction>
  HWY_INLINE WordVec along(hn::Vec<Ints> values) const {
    return hn::SaturatedAdd(broadcast<kFunction>(values), lanes_[kFunction]);
  }

 private:
  static constexpr float kRowOfLane[8] = {0, 0, 0, 0, 1, 1, 1, 1};

  FloatVec first_;
  FloatVec perColumn_;
  FloatVec perRow_;
  WordVec lanes_[4];
};

/// The samples inside a face.
class Coverage {
 public:
  HWY_INLINE Coverage(const FaceBatch& batch, std::size_t face, const HalfPlanes& halfPlanes)
      : planes_(batch.edges, face) {
    for (std::size_t k = 0; k < 4; ++k) tables_[k] = &halfPlanes.at(batch.halfPlane[face][k]);
  }

  HWY_INLINE MaskVec at(int column, int row) const {
    const auto values = planes_.at(column, row);
    return hn::And(hn::And(inside<0>(values), inside<1>(values)), hn::And(inside<2>(values), inside<3>(values)));
  }

 private:
  template <int kEdge>
  HWY_INLINE MaskVec inside(hn::Vec<Ints> values) const {
    const Words words;
    const Bytes bytes;
    const auto distance = hn::Min(hn::Max(planes_.along<kEdge>(values), hn::Zero(words)), hn::Set(words, 255));
    const auto index = hn::ShiftRight<4>(distance);
    const auto indices = hn::BitCast(bytes, hn::Or(index, hn::ShiftLeft<8>(index)));
    const auto low = hn::TableLookupBytes(hn::LoadDup128(bytes, tables_[kEdge]->low.data()), indices);
    const auto high = hn::TableLookupBytes(hn::LoadDup128(bytes, tables_[kEdge]->high.data()), indices);
    return hn::BitCast(Masks(), hn::OddEven(high, low));
  }

  const HalfPlanes::Masks* tables_[4];
  Planes planes_;
};

/// A face's nearness and colour, interpolated between its corners on the screen: faces are so small that perspective
/// makes no visible difference within one. Values are clamped to the corners' range, as the centre of a partly covered
/// pixel can be outside the face.
class Surface {
 public:
  HWY_INLINE Surface(const FaceBatch& batch, std::size_t face) : planes_(batch.inner, face) {
    const auto least = rounded(hn::LoadDup128(Floats(), batch.least[face]));
    const auto most = rounded(hn::LoadDup128(Floats(), batch.most[face]));
    least_[0] = hn::Max(broadcast<0>(least), hn::Set(Words(), 1));
    least_[1] = broadcast<1>(least);
    least_[2] = broadcast<2>(least);
    least_[3] = broadcast<3>(least);
    most_[0] = hn::Max(broadcast<0>(most), hn::Set(Words(), 1));
    most_[1] = broadcast<1>(most);
    most_[2] = broadcast<2>(most);
    most_[3] = broadcast<3>(most);
  }

  HWY_INLINE hn::Vec<Ints> at(int column, int row) const { return planes_.at(column, row); }
  HWY_INLINE WordVec nearness(hn::Vec<Ints> values) const { return limited<0>(values); }
  HWY_INLINE void colours(hn::Vec<Ints> values, MaskVec (&to)[3]) const {
    to[0] = channel<1>(values);
    to[1] = channel<2>(values);
    to[2] = channel<3>(values);
  }

 private:
  template <int kFunction>
  HWY_INLINE WordVec limited(hn::Vec<Ints> values) const {
    return hn::Min(hn::Max(planes_.along<kFunction>(values), least_[kFunction]), most_[kFunction]);
  }
  template <int kFunction>
  HWY_INLINE MaskVec channel(hn::Vec<Ints> values) const {
    static_assert(kColourUnit == 64.0F);
    return hn::BitCast(Masks(), hn::ShiftRight<6>(limited<kFunction>(values)));
  }

  Planes planes_;
  WordVec least_[4];
  WordVec most_[4];
};

/// Rows of NearPixels whose spans are computed at once.
using SpanTag = hn::CappedTag<float, 8>;
constexpr int kSpanRows = static_cast<int>(hn::MaxLanes(SpanTag()));

/// By row of NearPixels, the columns from `begin` to before `end`.
struct Spans {
  HWY_INLINE Spans(const FaceBatch& batch, std::size_t face, int firstRow) {
    const SpanTag tag;
    const hn::RebindToSigned<SpanTag> ints;
    if (batch.left[face] + 1 == batch.right[face]) {
      hn::Store(hn::Set(ints, batch.left[face]), ints, begin);
      hn::Store(hn::Set(ints, batch.right[face]), ints, end);
      return;
    }
    const auto row = hn::ConvertTo(tag, hn::Iota(ints, firstRow));
    const auto top = hn::MulAdd(row, hn::Set(tag, float{NearPixels::kRows}), hn::Set(tag, -0.5F - kCoverageMargin));
    const auto bottom = hn::Add(top, hn::Set(tag, NearPixels::kRows + 2.0F * kCoverageMargin));
    auto least = hn::Set(tag, 1.0e6F);
    auto most = hn::Set(tag, -1.0e6F);
    for (std::size_t k = 0; k < 4; ++k) {
      const auto upperY = hn::Set(tag, batch.upperY[face][k]);
      const auto slope = hn::Set(tag, batch.slope[face][k]);
      const auto upperX = hn::Set(tag, batch.upperX[face][k]);
      const auto first = hn::Max(top, upperY);
      const auto last = hn::Min(bottom, hn::Set(tag, batch.lowerY[face][k]));
      const auto firstX = hn::MulAdd(hn::Sub(first, upperY), slope, upperX);
      const auto lastX = hn::MulAdd(hn::Sub(last, upperY), slope, upperX);
      const auto isThere = hn::Le(first, last);
      least = hn::IfThenElse(isThere, hn::Min(least, hn::Min(firstX, lastX)), least);
      most = hn::IfThenElse(isThere, hn::Max(most, hn::Max(firstX, lastX)), most);
    }
    const auto column = [&](hn::Vec<SpanTag> place, float margin) {
      constexpr float kPerColumn = 1.0F / NearPixels::kColumns;
      const auto inTile = hn::Mul(hn::Add(place, hn::Set(tag, margin)), hn::Set(tag, kPerColumn));
      return hn::ConvertTo(ints, hn::Min(hn::Max(inTile, hn::Zero(tag)), hn::Set(tag, float{NearCanvas::kAcross})));
    };
    constexpr float kMargin = 2.0F * kCoverageMargin;
    hn::Store(hn::Max(column(least, 0.5F - kMargin), hn::Set(ints, batch.left[face])), ints, begin);
    const auto last = hn::Add(column(most, 0.5F + kMargin), hn::Set(ints, 1));
    hn::Store(hn::Min(last, hn::Set(ints, batch.right[face])), ints, end);
  }

  HWY_ALIGN std::int32_t begin[kSpanRows];
  HWY_ALIGN std::int32_t end[kSpanRows];
};

}  // namespace grove::objects::lightfield::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // once per target
