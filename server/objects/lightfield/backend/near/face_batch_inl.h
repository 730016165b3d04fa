// Sets up faces for drawing: edges, planes and bounding boxes, a vector of faces at a time. Only for exact kernels
// (GroveTargets.cmake).

#if defined(GROVE_OBJECTS_LIGHTFIELD_BACKEND_NEAR_FACE_BATCH_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef GROVE_OBJECTS_LIGHTFIELD_BACKEND_NEAR_FACE_BATCH_INL_H
#undef GROVE_OBJECTS_LIGHTFIELD_BACKEND_NEAR_FACE_BATCH_INL_H
#else
#define GROVE_OBJECTS_LIGHTFIELD_BACKEND_NEAR_FACE_BATCH_INL_H
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "objects/lightfield/backend/near/half_planes.h"
#include "objects/lightfield/backend/near/near_canvas.h"
#include "objects/lightfield/backend/near/near_tiles.h"

HWY_BEFORE_NAMESPACE();
namespace grove::objects::lightfield::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using BatchTag = hn::CappedTag<float, 8>;
using BatchInts = hn::RebindToSigned<BatchTag>;
using BatchVec = hn::Vec<BatchTag>;
constexpr std::size_t kBatch = hn::MaxLanes(BatchTag());

/// Four linear functions of the screen position, whose origin is the centre of the tile's first pixel.
struct LinearFunctions {
  HWY_ALIGN float first[kBatch][4];
  HWY_ALIGN float perColumn[kBatch][4];
  HWY_ALIGN float perRow[kBatch][4];
};

/// The set-up of kBatch faces. The origin is the centre of the tile's first pixel.
struct FaceBatch {
  LinearFunctions edges;  ///< distances, positive on the right-hand side or below, in units of kDistanceUnit, plus 128
  LinearFunctions inner;  ///< nearness in units of kNearnessUnit; R, G and B in units of 1 / kColourUnit
  HWY_ALIGN float least[kBatch][4];  ///< ranges of `inner`
  HWY_ALIGN float most[kBatch][4];
  HWY_ALIGN std::int32_t halfPlane[kBatch][4];  ///< by edge: index into HalfPlanes
  HWY_ALIGN float upperX[kBatch][4];            ///< by edge: its upper end, and its slope
  HWY_ALIGN float upperY[kBatch][4];
  HWY_ALIGN float lowerY[kBatch][4];
  HWY_ALIGN float slope[kBatch][4];
  HWY_ALIGN std::int32_t left[kBatch];  ///< NearPixels that the face touches
  HWY_ALIGN std::int32_t right[kBatch];
  HWY_ALIGN std::int32_t top[kBatch];
  HWY_ALIGN std::int32_t bottom[kBatch];
};

/// Units of a distance from an edge: sixteenths of a step of HalfPlanes.
constexpr float kDistanceUnit = 16.0F / HalfPlanes::kDistanceStep;
constexpr float kColourUnit = 64.0F;

/// Four values per face: one vector of faces for each value.
struct Quads {
  BatchVec v[4];

  HWY_INLINE BatchVec least() const { return hn::Min(hn::Min(v[0], v[1]), hn::Min(v[2], v[3])); }
  HWY_INLINE BatchVec most() const { return hn::Max(hn::Max(v[0], v[1]), hn::Max(v[2], v[3])); }
  HWY_INLINE BatchVec mean() const {
    return hn::Mul(hn::Add(hn::Add(v[0], v[1]), hn::Add(v[2], v[3])), hn::Set(BatchTag(), 0.25F));
  }
  HWY_INLINE void store(float (*to)[4]) const { hn::StoreInterleaved4(v[0], v[1], v[2], v[3], BatchTag(), to[0]); }
};

/// Loads values of the corners of kBatch faces.
template <class Get>
HWY_INLINE Quads loadQuads(const Get& get) {
  const hn::FixedTag<float, 4> four;
  HWY_ALIGN float values[kBatch][4];
  for (std::size_t i = 0; i < kBatch; ++i) hn::Store(hn::Load(four, get(i)), four, values[i]);
  Quads quads;
  hn::LoadInterleaved4(BatchTag(), values[0], quads.v[0], quads.v[1], quads.v[2], quads.v[3]);
  return quads;
}

/// Fits planes to values at the four corners, by the gradients along the two diagonals.
class Diagonals {
 public:
  HWY_INLINE Diagonals(const Quads& x, const Quads& y)
      : x02_(hn::Sub(x.v[2], x.v[0])),
        y02_(hn::Sub(y.v[2], y.v[0])),
        x13_(hn::Sub(x.v[3], x.v[1])),
        y13_(hn::Sub(y.v[3], y.v[1])),
        meanX_(x.mean()),
        meanY_(y.mean()) {
    twiceArea_ = hn::Sub(hn::Mul(x02_, y13_), hn::Mul(x13_, y02_));
    perArea_ = hn::Div(hn::Set(BatchTag(), 1.0F), twiceArea_);
  }

  HWY_INLINE hn::Mask<BatchTag> isClockwise() const { return hn::Gt(twiceArea_, hn::Zero(BatchTag())); }

  HWY_INLINE void plane(const Quads& values, BatchVec& first, BatchVec& perColumn, BatchVec& perRow) const {
    const BatchVec along02 = hn::Sub(values.v[2], values.v[0]);
    const BatchVec along13 = hn::Sub(values.v[3], values.v[1]);
    perColumn = hn::Mul(hn::Sub(hn::Mul(along02, y13_), hn::Mul(along13, y02_)), perArea_);
    perRow = hn::Mul(hn::Sub(hn::Mul(along13, x02_), hn::Mul(along02, x13_)), perArea_);
    first = hn::Sub(values.mean(), hn::Add(hn::Mul(perColumn, meanX_), hn::Mul(perRow, meanY_)));
  }

 private:
  BatchVec x02_, y02_, x13_, y13_;
  BatchVec meanX_, meanY_;
  BatchVec twiceArea_, perArea_;
};

/// One edge of each face, directed from left to right, so that both faces of an edge compute the same values.
struct EdgeOfFaces {
  HWY_INLINE EdgeOfFaces(BatchVec ax, BatchVec ay, BatchVec bx, BatchVec by, hn::Mask<BatchTag> isClockwise) {
    const BatchTag tag;
    const auto zero = hn::Zero(tag);
    const auto isForward = hn::Or(hn::Gt(bx, ax), hn::And(hn::Eq(bx, ax), hn::Lt(by, ay)));
    const auto fromX = hn::IfThenElse(isForward, ax, bx);
    const auto fromY = hn::IfThenElse(isForward, ay, by);
    const auto alongX = hn::Sub(hn::IfThenElse(isForward, bx, ax), fromX);
    const auto alongY = hn::Sub(hn::IfThenElse(isForward, by, ay), fromY);
    const auto length = hn::Sqrt(hn::Add(hn::Mul(alongX, alongX), hn::Mul(alongY, alongY)));
    const auto isPoint = hn::Eq(length, zero);
    const auto scale = hn::IfThenElseZero(hn::Gt(length, zero), hn::Div(hn::Set(tag, kDistanceUnit), length));
    perColumn = hn::Neg(hn::Mul(alongY, scale));
    perRow = hn::Mul(alongX, scale);
    const auto isFlipped = hn::Xor(isForward, isClockwise);
    // The fourth edge of a triangle has no length; all samples are inside it.
    const auto everywhere = hn::IfThenElse(isFlipped, hn::Set(tag, -32767.0F), hn::Set(tag, 32767.0F));
    constexpr float kMiddle = 8.0F * HalfPlanes::kDistances;
    const auto distance = hn::Add(hn::Mul(perColumn, fromX), hn::Mul(perRow, fromY));
    first = hn::IfThenElse(isPoint, everywhere, hn::Sub(hn::Set(tag, kMiddle), distance));

    const auto half = hn::Set(tag, 0.5F * (HalfPlanes::kSlopes - 1));
    const auto sum = hn::IfThenElse(isPoint, hn::Set(tag, 1.0F), hn::Add(hn::Abs(alongY), alongX));
    const auto slopeOfNormal = hn::Sub(half, hn::Mul(hn::Div(alongY, sum), half));
    const auto others = hn::IfThenElseZero(isFlipped, hn::Set(tag, float{HalfPlanes::kSlopes}));
    halfPlane = hn::BitCast(tag, hn::NearestInt(hn::Add(slopeOfNormal, others)));

    const auto isDown = hn::Lt(ay, by);
    upperX = hn::IfThenElse(isDown, ax, bx);
    // A horizontal edge needs no span: its neighbours have the same ends.
    upperY = hn::IfThenElse(hn::Eq(ay, by), hn::Set(tag, 1.0e9F), hn::Min(ay, by));
    lowerY = hn::Max(ay, by);
    slope = hn::Div(hn::Sub(bx, ax), hn::Sub(by, ay));
  }

  BatchVec first, perColumn, perRow;
  BatchVec halfPlane;  // bits of integers
  BatchVec upperX, upperY, lowerY, slope;
};

/// Converts pixels to an index of NearPixels that are `size` pixels wide or high.
HWY_INLINE hn::Vec<BatchInts> unitOf(BatchVec place, int size) {
  const BatchTag tag;
  const auto inTile = hn::Min(hn::Max(place, hn::Zero(tag)), hn::Set(tag, kNearTile - 0.5F));
  return hn::ConvertTo(BatchInts(), hn::Mul(inTile, hn::Set(tag, 1.0F / static_cast<float>(size))));
}

HWY_INLINE void makeExtents(const Quads& x, const Quads& y, FaceBatch& to) {
  const BatchTag tag;
  const BatchInts ints;
  const auto one = hn::Set(ints, 1);
  const auto margin = [&](float offset) { return hn::Set(tag, 0.5F + offset); };
  hn::Store(unitOf(hn::Add(x.least(), margin(-kCoverageMargin)), NearPixels::kColumns), ints, to.left);
  hn::Store(hn::Add(unitOf(hn::Add(x.most(), margin(kCoverageMargin)), NearPixels::kColumns), one), ints, to.right);
  hn::Store(unitOf(hn::Add(y.least(), margin(-kCoverageMargin)), NearPixels::kRows), ints, to.top);
  hn::Store(hn::Add(unitOf(hn::Add(y.most(), margin(kCoverageMargin)), NearPixels::kRows), one), ints, to.bottom);
}

HWY_INLINE void makeEdges(const Quads& x, const Quads& y, const Diagonals& diagonals, FaceBatch& to) {
  const auto isClockwise = diagonals.isClockwise();
  const auto edge = [&](std::size_t from, std::size_t next) {
    return EdgeOfFaces(x.v[from], y.v[from], x.v[next], y.v[next], isClockwise);
  };
  const EdgeOfFaces a = edge(0, 1);
  const EdgeOfFaces b = edge(1, 2);
  const EdgeOfFaces c = edge(2, 3);
  const EdgeOfFaces d = edge(3, 0);
  const auto store = [&](BatchVec EdgeOfFaces::*value, float* at) {
    hn::StoreInterleaved4(a.*value, b.*value, c.*value, d.*value, BatchTag(), at);
  };
  store(&EdgeOfFaces::first, to.edges.first[0]);
  store(&EdgeOfFaces::perColumn, to.edges.perColumn[0]);
  store(&EdgeOfFaces::perRow, to.edges.perRow[0]);
  store(&EdgeOfFaces::halfPlane, reinterpret_cast<float*>(to.halfPlane[0]));
  store(&EdgeOfFaces::upperX, to.upperX[0]);
  store(&EdgeOfFaces::upperY, to.upperY[0]);
  store(&EdgeOfFaces::lowerY, to.lowerY[0]);
  store(&EdgeOfFaces::slope, to.slope[0]);
}

/// `colours`: bits of R, G, B, 255.
HWY_INLINE void makeInner(const Quads& nearness, const Quads& colours, const Diagonals& diagonals, FaceBatch& to) {
  const BatchTag tag;
  const BatchInts ints;
  Quads first, perColumn, perRow, least, most;
  const auto add = [&](std::size_t function, const Quads& values) {
    diagonals.plane(values, first.v[function], perColumn.v[function], perRow.v[function]);
    least.v[function] = values.least();
    most.v[function] = values.most();
  };
  Quads values;
  for (std::size_t k = 0; k < 4; ++k) values.v[k] = hn::Mul(nearness.v[k], hn::Set(tag, kNearnessUnit));
  add(0, values);
  const auto channel = [&](std::size_t function, const auto& shifted) {
    for (std::size_t k = 0; k < 4; ++k) {
      const auto byte = hn::And(shifted(hn::BitCast(ints, colours.v[k])), hn::Set(ints, 0xFF));
      values.v[k] = hn::Mul(hn::ConvertTo(tag, byte), hn::Set(tag, kColourUnit));
    }
    add(function, values);
  };
  channel(1, [](hn::Vec<BatchInts> bits) { return bits; });
  channel(2, [](hn::Vec<BatchInts> bits) { return hn::ShiftRight<8>(bits); });
  channel(3, [](hn::Vec<BatchInts> bits) { return hn::ShiftRight<16>(bits); });
  first.store(to.inner.first);
  perColumn.store(to.inner.perColumn);
  perRow.store(to.inner.perRow);
  least.store(to.least);
  most.store(to.most);
}

/// Sets up faces of the tile at that column and row.
HWY_INLINE void prepareFaces(const ScreenFace* const (&faces)[kBatch], int column, int row, FaceBatch& to) {
  const BatchTag tag;
  Quads x = loadQuads([&](std::size_t i) { return faces[i]->x; });
  Quads y = loadQuads([&](std::size_t i) { return faces[i]->y; });
  for (BatchVec& v : x.v) v = hn::Sub(v, hn::Set(tag, static_cast<float>(column * kNearTile) + 0.5F));
  for (BatchVec& v : y.v) v = hn::Sub(v, hn::Set(tag, static_cast<float>(row * kNearTile) + 0.5F));
  const Diagonals diagonals(x, y);
  makeExtents(x, y, to);
  makeEdges(x, y, diagonals, to);
  makeInner(loadQuads([&](std::size_t i) { return faces[i]->nearness; }),
            loadQuads([&](std::size_t i) { return reinterpret_cast<const float*>(faces[i]->colour); }), diagonals, to);
}

}  // namespace grove::objects::lightfield::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // once per target
