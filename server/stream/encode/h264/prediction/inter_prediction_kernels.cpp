#include "stream/encode/h264/prediction/inter_prediction_kernels.h"

#include <type_traits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "stream/encode/h264/prediction/inter_prediction_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "stream/encode/h264/prediction/difference_inl.h"

HWY_BEFORE_NAMESPACE();
namespace grove::stream::h264::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

constexpr std::ptrdiff_t kTo = MacroblockPixels::kStride;

/// Luma of a square of kSide pixels, and its difference from the source. A vector has two rows of it, half a square
/// apart, or a part of a row.
template <int kSide>
class LumaBlock {
 public:
  /// `from`: the pixel at the whole part of the vector.
  HWY_INLINE LumaBlock(const std::uint8_t* from, std::ptrdiff_t stride, const std::uint8_t* source, std::uint8_t* to)
      : from_(from), stride_(stride), source_(source), to_(to) {}

  /// `x` and `y`: quarters of a pixel.
  HWY_INLINE void predict(int x, int y) {
    const std::ptrdiff_t right = x == 3 ? 1 : 0;
    const std::ptrdiff_t below = y == 3 ? stride_ : 0;
    if (x == 0 && y == 0) {
      each([&](std::ptrdiff_t at) { return whole(at); });
    } else if (y == 0 && x == 2) {
      each([&](std::ptrdiff_t at) { return across(at); });
    } else if (y == 0) {
      each([&](std::ptrdiff_t at) { return mean(across(at), whole(at + right)); });
    } else if (x == 0 && y == 2) {
      eachDown(0, [&](std::ptrdiff_t, ByteVec down, std::ptrdiff_t to) { finish(down, to); });
    } else if (x == 0) {
      eachDown(0,
               [&](std::ptrdiff_t at, ByteVec down, std::ptrdiff_t to) { finish(mean(down, whole(at + below)), to); });
    } else if (x != 2 && y != 2) {
      eachDown(right,
               [&](std::ptrdiff_t at, ByteVec down, std::ptrdiff_t to) { finish(mean(across(at + below), down), to); });
    } else {
      predictMiddle(x, y);
    }
  }

  /// The sum of absolute differences from the source.
  [[nodiscard]] HWY_INLINE int difference() const { return difference_.total(); }

 private:
  using Words = hn::CappedTag<std::int16_t, 2 * kSide>;
  using Bytes = hn::Rebind<std::uint8_t, Words>;
  using Vec = hn::Vec<Words>;
  using ByteVec = hn::Vec<Bytes>;
  static constexpr int kLanes = static_cast<int>(hn::MaxLanes(Words()));
  static constexpr bool kPairs = kLanes > kSide;
  static constexpr int kColumns = kPairs ? kSide : kLanes;  ///< of a vector
  static constexpr int kLines = kPairs ? kSide / 2 : kSide;
  static constexpr int kTaps = 6;

  static HWY_INLINE ByteVec load(const std::uint8_t* at, std::ptrdiff_t stride) {
    if constexpr (kPairs) {
      const hn::Half<Bytes> half;
      return hn::Combine(Bytes(), hn::LoadU(half, at + kLines * stride), hn::LoadU(half, at));
    } else {
      return hn::LoadU(Bytes(), at);
    }
  }
  HWY_INLINE void store(ByteVec value, std::ptrdiff_t to) const {
    if constexpr (kPairs) {
      const hn::Half<Bytes> half;
      hn::StoreU(hn::LowerHalf(half, value), half, to_ + to);
      hn::StoreU(hn::UpperHalf(half, value), half, to_ + to + kLines * kTo);
    } else {
      hn::StoreU(value, Bytes(), to_ + to);
    }
  }
  HWY_INLINE void finish(ByteVec value, std::ptrdiff_t to) {
    store(value, to);
    difference_.add(value, load(source_ + to, kTo));
  }
  template <class Get>
  HWY_INLINE void each(const Get& get) {
    for (int y = 0; y < kLines; ++y) {
      for (int x = 0; x < kSide; x += kColumns) finish(get(y * stride_ + x), y * kTo + x);
    }
  }
  /// `take` gets a place, the pixels filtered down the column that is `right` of it, and where they belong.
  template <class Take>
  HWY_INLINE void eachDown(std::ptrdiff_t right, const Take& take) {
    for (int x = 0; x < kSide; x += kColumns) {
      const auto row = [&](int y) { return word(y * stride_ + x + right); };
      Vec a = row(-2), b = row(-1), c = row(0), d = row(1), e = row(2);
      for (int y = 0; y < kLines; ++y) {
        const Vec f = row(y + 3);
        take(y * stride_ + x, rounded(taps(hn::Add(a, f), hn::Add(b, e), hn::Add(c, d))), y * kTo + x);
        a = b;
        b = c;
        c = d;
        d = e;
        e = f;
      }
    }
  }
  HWY_INLINE ByteVec whole(std::ptrdiff_t at) const { return load(from_ + at, stride_); }
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

  /// Vectors of a line, and values.
  static constexpr int kParts = kSide / kColumns;
  static constexpr int kLineValues = kParts * kLanes;

  /// The filter down rows that were filtered across, divided by 1024. Sums are divided by four twice so that they fit
  /// into 16 bits; where one saturates, the result is beyond a byte's range anyway.
  static HWY_INLINE ByteVec filteredTwice(const std::int16_t* rows) {
    const Words words;
    const auto row = [&](int i) { return hn::Load(words, rows + std::ptrdiff_t{i} * kLineValues); };
    const Vec outer = hn::Add(row(0), row(5));
    const Vec middle = hn::Add(row(1), row(4));
    const Vec inner = hn::Add(row(2), row(3));
    const Vec quarter = hn::ShiftRight<2>(hn::SaturatedSub(outer, middle));
    const Vec sum = hn::ShiftRight<2>(hn::SaturatedAdd(hn::Sub(quarter, middle), inner));
    return hn::DemoteTo(Bytes(), hn::ShiftRight<6>(hn::Add(hn::SaturatedAdd(sum, inner), hn::Set(words, 32))));
  }

  /// `x` or `y` is 2.
  HWY_INLINE void predictMiddle(int x, int y) {
    const Words words;
    HWY_ALIGN std::int16_t rows[(kLines + kTaps - 1) * kLineValues];
    for (int line = 0; line < kLines + kTaps - 1; ++line) {
      for (int i = 0; i < kParts; ++i) {
        hn::Store(filteredAcross((line - 2) * stride_ + i * kColumns), words, rows + line * kLineValues + i * kLanes);
      }
    }
    /// `other` gets the pixels, their filtered rows, and where they belong.
    const auto middle = [&](const auto& other) {
      for (int line = 0; line < kLines; ++line) {
        for (int i = 0; i < kParts; ++i) {
          const std::int16_t* const at = rows + line * kLineValues + i * kLanes;
          const std::ptrdiff_t to = line * kTo + i * kColumns;
          finish(other(filteredTwice(at), at, to), to);
        }
      }
    };
    if (x == 2 && y == 2) {
      middle([](ByteVec value, const std::int16_t*, std::ptrdiff_t) { return value; });
    } else if (x == 2) {
      const int first = y == 3 ? 3 : 2;
      middle([&](ByteVec value, const std::int16_t* at, std::ptrdiff_t) {
        return mean(value, rounded(hn::Load(words, at + first * kLineValues)));
      });
    } else {
      eachDown(x == 3 ? 1 : 0, [&](std::ptrdiff_t, ByteVec down, std::ptrdiff_t to) { store(down, to); });
      middle([&](ByteVec value, const std::int16_t*, std::ptrdiff_t to) { return mean(value, load(to_ + to, kTo)); });
    }
  }

  const std::uint8_t* from_;
  std::ptrdiff_t stride_;
  const std::uint8_t* source_;
  std::uint8_t* to_;
  DifferenceSum<Bytes> difference_;
};

/// Section 8.4.2.2.2: kSide rows. `x` and `y`: eighths of a pixel. `load` returns the bytes at an offset, and `store`
/// gets a row's number and bytes.
template <int kSide, class Words, class Load, class Store>
HWY_INLINE void predictChromaRows(Words words, std::ptrdiff_t stride, int x, int y, const Load& load,
                                  const Store& store) {
  const hn::Rebind<std::uint8_t, Words> bytes;
  const auto weight = [&](int value) { return hn::Set(words, static_cast<std::uint16_t>(value)); };
  const auto topLeft = weight((8 - x) * (8 - y));
  const auto topRight = weight(x * (8 - y));
  const auto lowLeft = weight((8 - x) * y);
  const auto lowRight = weight(x * y);
  const auto word = [&](std::ptrdiff_t at) { return hn::PromoteTo(words, load(at)); };
  auto left = word(0);
  auto right = word(1);
  for (int line = 0; line < kSide; ++line) {
    const std::ptrdiff_t next = (line + 1) * stride;
    const auto nextLeft = word(next);
    const auto nextRight = word(next + 1);
    const auto above = hn::Add(hn::Mul(left, topLeft), hn::Mul(right, topRight));
    const auto below = hn::Add(hn::Mul(nextLeft, lowLeft), hn::Mul(nextRight, lowRight));
    const auto sum = hn::ShiftRight<6>(hn::Add(hn::Add(above, below), hn::Set(words, 32)));
    store(line, hn::DemoteTo(bytes, hn::BitCast(hn::RebindToSigned<Words>(), sum)));
    left = nextLeft;
    right = nextRight;
  }
}

/// Squares of kSide pixels of U and V, side by side in a vector if it has room.
template <int kSide>
HWY_INLINE void predictChromaSquares(const std::uint8_t* u, const std::uint8_t* v, std::ptrdiff_t stride, int x, int y,
                                     std::uint8_t* to) {
  using Words = hn::CappedTag<std::uint16_t, 2 * kSide>;
  constexpr std::ptrdiff_t kV = kMacroblock / 2;
  if constexpr (hn::MaxLanes(Words()) == 2 * kSide) {
    const hn::Rebind<std::uint8_t, Words> both;
    const hn::Half<decltype(both)> half;
    predictChromaRows<kSide>(
        Words(), stride, x, y,
        [&](std::ptrdiff_t at) { return hn::Combine(both, hn::LoadU(half, v + at), hn::LoadU(half, u + at)); },
        [&](int line, auto pixels) {
          hn::StoreU(hn::LowerHalf(half, pixels), half, to + line * kTo);
          hn::StoreU(hn::UpperHalf(half, pixels), half, to + line * kTo + kV);
        });
  } else {
    const auto predict = [&](const std::uint8_t* from, std::uint8_t* place) {
      const hn::Rebind<std::uint8_t, Words> bytes;
      predictChromaRows<kSide>(
          Words(), stride, x, y, [&](std::ptrdiff_t at) { return hn::LoadU(bytes, from + at); },
          [&](int line, auto pixels) { hn::StoreU(pixels, bytes, place + line * kTo); });
    };
    predict(u, to);
    predict(v, to + kV);
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

int predictLuma(const ReferencePicture& reference, int column, int row, const std::array<MotionVector, 4>& vectors,
                const MacroblockPixels& source, MacroblockPixels& to) {
  const BorderedPlane& plane = reference.plane(0);
  int difference = 0;
  forSquares(vectors, [&](auto side, int left, int top, const MotionVector& vector) {
    const int x = column * kMacroblock + left + (vector.x >> 2);
    const int y = row * kMacroblock + top + (vector.y >> 2);
    const std::ptrdiff_t at = top * kTo + left;
    LumaBlock<side> block(plane.at(x, y), plane.stride, source.luma.data() + at, to.luma.data() + at);
    block.predict(vector.x & 3, vector.y & 3);
    difference += block.difference();
  });
  return difference;
}

void predictChroma(const ReferencePicture& reference, int column, int row, const std::array<MotionVector, 4>& vectors,
                   MacroblockPixels& to) {
  forSquares(vectors, [&](auto side, int left, int top, const MotionVector& vector) {
    const int x = column * kMacroblock / 2 + left / 2 + (vector.x >> 3);
    const int y = row * kMacroblock / 2 + top / 2 + (vector.y >> 3);
    predictChromaSquares<side / 2>(reference.plane(1).at(x, y), reference.plane(2).at(x, y), reference.plane(1).stride,
                                   vector.x & 7, vector.y & 7, to.chroma.data() + top / 2 * kTo + left / 2);
  });
}

}  // namespace grove::stream::h264::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace grove::stream::h264 {

HWY_EXPORT(predictLuma);
HWY_EXPORT(predictChroma);

int predictLuma(const ReferencePicture& reference, int column, int row, const std::array<MotionVector, 4>& vectors,
                const MacroblockPixels& source, MacroblockPixels& to) {
  return HWY_DYNAMIC_DISPATCH(predictLuma)(reference, column, row, vectors, source, to);
}

void predictChroma(const ReferencePicture& reference, int column, int row, const std::array<MotionVector, 4>& vectors,
                   MacroblockPixels& to) {
  HWY_DYNAMIC_DISPATCH(predictChroma)(reference, column, row, vectors, to);
}

}  // namespace grove::stream::h264

#endif  // HWY_ONCE
