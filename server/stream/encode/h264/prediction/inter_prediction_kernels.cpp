#include "stream/encode/h264/prediction/inter_prediction_kernels.h"

#include <type_traits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "stream/encode/h264/prediction/inter_prediction_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace grove::stream::h264::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

constexpr std::ptrdiff_t kTo = MacroblockPixels::kStride;

/// Luma of a square of kSide pixels, kLanes columns at a time.
template <int kSide>
class LumaBlock {
 public:
  /// `from`: the pixel at the whole part of the vector.
  HWY_INLINE LumaBlock(const std::uint8_t* from, std::ptrdiff_t stride, std::uint8_t* to)
      : from_(from), stride_(stride), to_(to) {}

  /// `x` and `y`: quarters of a pixel.
  HWY_INLINE void predict(int x, int y) const {
    const std::ptrdiff_t right = x == 3 ? 1 : 0;
    const std::ptrdiff_t below = y == 3 ? stride_ : 0;
    if (x == 0 && y == 0) {
      each([&](std::ptrdiff_t at) { return whole(at); });
    } else if (y == 0 && x == 2) {
      each([&](std::ptrdiff_t at) { return across(at); });
    } else if (y == 0) {
      each([&](std::ptrdiff_t at) { return mean(across(at), whole(at + right)); });
    } else if (x == 0 && y == 2) {
      eachDown(0, [](std::ptrdiff_t, ByteVec down) { return down; });
    } else if (x == 0) {
      eachDown(0, [&](std::ptrdiff_t at, ByteVec down) { return mean(down, whole(at + below)); });
    } else if (x != 2 && y != 2) {
      eachDown(right, [&](std::ptrdiff_t at, ByteVec down) { return mean(across(at + below), down); });
    } else {
      predictMiddle(x, y);
    }
  }

 private:
  using Words = hn::CappedTag<std::int16_t, kSide>;
  using Bytes = hn::Rebind<std::uint8_t, Words>;
  using Vec = hn::Vec<Words>;
  using ByteVec = hn::Vec<Bytes>;
  static constexpr int kLanes = static_cast<int>(hn::MaxLanes(Words()));
  static constexpr int kTaps = 6;

  template <class Get>
  HWY_INLINE void each(const Get& get) const {
    for (int y = 0; y < kSide; ++y) {
      for (int x = 0; x < kSide; x += kLanes) hn::StoreU(get(y * stride_ + x), Bytes(), to_ + y * kTo + x);
    }
  }
  /// `get` also gets the pixels filtered down the column that is `right` of it.
  template <class Get>
  HWY_INLINE void eachDown(std::ptrdiff_t right, const Get& get) const {
    for (int x = 0; x < kSide; x += kLanes) {
      const auto row = [&](int y) { return word(y * stride_ + x + right); };
      Vec a = row(-2), b = row(-1), c = row(0), d = row(1), e = row(2);
      for (int y = 0; y < kSide; ++y) {
        const Vec f = row(y + 3);
        const ByteVec down = rounded(taps(hn::Add(a, f), hn::Add(b, e), hn::Add(c, d)));
        hn::StoreU(get(y * stride_ + x, down), Bytes(), to_ + y * kTo + x);
        a = b;
        b = c;
        c = d;
        d = e;
        e = f;
      }
    }
  }
  HWY_INLINE ByteVec whole(std::ptrdiff_t at) const { return hn::LoadU(Bytes(), from_ + at); }
  HWY_INLINE Vec word(std::ptrdiff_t at) const { return hn::PromoteTo(Words(), whole(at)); }
  static HWY_INLINE ByteVec mean(ByteVec a, ByteVec b) { return hn::AverageRound(a, b); }

  /// The filter of six taps, 1, -5 and 20 and back, from the sums of its outer, middle and inner pixels.
  static HWY_INLINE Vec taps(Vec outer, Vec middle, Vec inner) {
    return hn::Add(outer, hn::Mul(hn::Set(Words(), 5), hn::Sub(hn::ShiftLeft<2>(inner), middle)));
  }
  HWY_INLINE Vec filteredAcross(std::ptrdiff_t at) const {
    return taps(hn::Add(word(at - 2), word(at + 3)), hn::Add(word(at - 1), word(at + 2)),
                hn::Add(word(at), word(at + 1)));
  }
  static HWY_INLINE ByteVec rounded(Vec sum) {
    return hn::DemoteTo(Bytes(), hn::ShiftRight<5>(hn::Add(sum, hn::Set(Words(), 16))));
  }
  HWY_INLINE ByteVec across(std::ptrdiff_t at) const { return rounded(filteredAcross(at)); }

  /// The filter down rows that were filtered across, divided by 1024. Sums are divided by four twice so that they fit
  /// into 16 bits; where one saturates, the result is beyond a byte's range anyway.
  static HWY_INLINE ByteVec filteredTwice(const std::int16_t* rows) {
    const Words words;
    const auto row = [&](int i) { return hn::Load(words, rows + std::ptrdiff_t{i} * kSide); };
    const Vec outer = hn::Add(row(0), row(5));
    const Vec middle = hn::Add(row(1), row(4));
    const Vec inner = hn::Add(row(2), row(3));
    const Vec quarter = hn::ShiftRight<2>(hn::SaturatedSub(outer, middle));
    const Vec sum = hn::ShiftRight<2>(hn::SaturatedAdd(hn::Sub(quarter, middle), inner));
    return hn::DemoteTo(Bytes(), hn::ShiftRight<6>(hn::Add(hn::SaturatedAdd(sum, inner), hn::Set(words, 32))));
  }

  /// `x` or `y` is 2.
  HWY_INLINE void predictMiddle(int x, int y) const {
    const Words words;
    HWY_ALIGN std::int16_t rows[(kSide + kTaps - 1) * kSide];
    for (int line = 0; line < kSide + kTaps - 1; ++line) {
      for (int i = 0; i < kSide; i += kLanes) {
        hn::Store(filteredAcross((line - 2) * stride_ + i), words, rows + line * kSide + i);
      }
    }
    const auto middle = [&](const auto& other) {
      for (int line = 0; line < kSide; ++line) {
        for (int i = 0; i < kSide; i += kLanes) {
          hn::StoreU(other(filteredTwice(rows + line * kSide + i), line, i), Bytes(), to_ + line * kTo + i);
        }
      }
    };
    if (x == 2 && y == 2) {
      middle([](ByteVec value, int, int) { return value; });
    } else if (x == 2) {
      const int first = y == 3 ? 3 : 2;
      middle([&](ByteVec value, int line, int i) {
        return mean(value, rounded(hn::Load(words, rows + (line + first) * kSide + i)));
      });
    } else {
      eachDown(x == 3 ? 1 : 0, [&](std::ptrdiff_t, ByteVec down) { return down; });
      middle([&](ByteVec value, int line, int i) { return mean(value, hn::LoadU(Bytes(), to_ + line * kTo + i)); });
    }
  }

  const std::uint8_t* from_;
  std::ptrdiff_t stride_;
  std::uint8_t* to_;
};

/// Section 8.4.2.2.2. `x` and `y`: eighths of a pixel.
template <int kSide>
HWY_INLINE void predictChromaSquare(const std::uint8_t* from, std::ptrdiff_t stride, int x, int y, std::uint8_t* to) {
  const hn::CappedTag<std::uint16_t, kSide> words;
  const hn::Rebind<std::uint8_t, decltype(words)> bytes;
  const auto weight = [&](int value) { return hn::Set(words, static_cast<std::uint16_t>(value)); };
  const auto topLeft = weight((8 - x) * (8 - y));
  const auto topRight = weight(x * (8 - y));
  const auto lowLeft = weight((8 - x) * y);
  const auto lowRight = weight(x * y);
  const auto load = [&](const std::uint8_t* at) { return hn::PromoteTo(words, hn::LoadU(bytes, at)); };
  auto left = load(from);
  auto right = load(from + 1);
  for (int line = 0; line < kSide; ++line) {
    from += stride;
    const auto nextLeft = load(from);
    const auto nextRight = load(from + 1);
    const auto above = hn::Add(hn::Mul(left, topLeft), hn::Mul(right, topRight));
    const auto below = hn::Add(hn::Mul(nextLeft, lowLeft), hn::Mul(nextRight, lowRight));
    const auto sum = hn::ShiftRight<6>(hn::Add(hn::Add(above, below), hn::Set(words, 32)));
    hn::StoreU(hn::DemoteTo(bytes, hn::BitCast(hn::RebindToSigned<decltype(words)>(), sum)), bytes, to + line * kTo);
    left = nextLeft;
    right = nextRight;
  }
}

/// Calls `predict(side, left, top, vector)` for the macroblock, or for its 8 x 8 blocks: `side` is a constant, `left`
/// and `top` are pixels of luma from the macroblock's corner.
template <class Predict>
HWY_INLINE void forSquares(const std::array<MotionVector, 4>& vectors, const Predict& predict) {
  if (vectors[0] == vectors[1] && vectors[0] == vectors[2] && vectors[0] == vectors[3]) {
    predict(std::integral_constant<int, 16>(), 0, 0, vectors[0]);
    return;
  }
  for (int i = 0; i < 4; ++i) {
    predict(std::integral_constant<int, 8>(), i % 2 * 8, i / 2 * 8, vectors[static_cast<std::size_t>(i)]);
  }
}

void predictLuma(const ReferencePicture& reference, int column, int row, const std::array<MotionVector, 4>& vectors,
                 MacroblockPixels& to) {
  const BorderedPlane& plane = reference.plane(0);
  forSquares(vectors, [&](auto side, int left, int top, const MotionVector& vector) {
    const int x = column * kMacroblock + left + (vector.x >> 2);
    const int y = row * kMacroblock + top + (vector.y >> 2);
    const LumaBlock<side> block(plane.at(x, y), plane.stride, to.luma.data() + top * kTo + left);
    block.predict(vector.x & 3, vector.y & 3);
  });
}

void predictChroma(const ReferencePicture& reference, int column, int row, const std::array<MotionVector, 4>& vectors,
                   MacroblockPixels& to) {
  forSquares(vectors, [&](auto side, int left, int top, const MotionVector& vector) {
    const int x = column * kMacroblock / 2 + left / 2 + (vector.x >> 3);
    const int y = row * kMacroblock / 2 + top / 2 + (vector.y >> 3);
    for (std::size_t i = 1; i < 3; ++i) {
      const BorderedPlane& plane = reference.plane(i);
      std::uint8_t* const place = to.chroma.data() + top / 2 * kTo + left / 2 + (i == 1 ? 0 : 8);
      predictChromaSquare<side / 2>(plane.at(x, y), plane.stride, vector.x & 7, vector.y & 7, place);
    }
  });
}

}  // namespace grove::stream::h264::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace grove::stream::h264 {

HWY_EXPORT(predictLuma);
HWY_EXPORT(predictChroma);

void predictLuma(const ReferencePicture& reference, int column, int row, const std::array<MotionVector, 4>& vectors,
                 MacroblockPixels& to) {
  HWY_DYNAMIC_DISPATCH(predictLuma)(reference, column, row, vectors, to);
}

void predictChroma(const ReferencePicture& reference, int column, int row, const std::array<MotionVector, 4>& vectors,
                   MacroblockPixels& to) {
  HWY_DYNAMIC_DISPATCH(predictChroma)(reference, column, row, vectors, to);
}

}  // namespace grove::stream::h264

#endif  // HWY_ONCE
