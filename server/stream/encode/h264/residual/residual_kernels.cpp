#include "stream/encode/h264/residual/residual_kernels.h"

#include <cstring>

#include "stream/encode/h264/bits/coefficient_writer.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "stream/encode/h264/residual/residual_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "stream/encode/h264/residual/level_bits_inl.h"

HWY_BEFORE_NAMESPACE();
namespace grove::stream::h264::HWY_NAMESPACE {

/// A row of up to four blocks.
using Values = hn::CappedTag<std::int16_t, 16>;
using Magnitudes = hn::RebindToUnsigned<Values>;
using Bytes = hn::Rebind<std::uint8_t, Values>;
/// A row of one block per lane.
using Quads = hn::Repartition<std::uint64_t, Values>;
using Vec = hn::Vec<Values>;
using QuadVec = hn::Vec<Quads>;
constexpr int kLanes = static_cast<int>(hn::MaxLanes(Values()));
constexpr int kBlocks = kLanes / 4;

/// Four rows, or columns, of kBlocks blocks.
struct Rows {
  Vec v[4];
};

/// Exchanges rows and columns of each block.
HWY_INLINE Rows transposed(const Rows& rows) {
  const Values words;
  const hn::Repartition<std::uint32_t, Values> pairs;
  const Quads quads;
  const auto pair = [&](Vec v) { return hn::BitCast(pairs, v); };
  const auto even01 = pair(hn::InterleaveLower(words, rows.v[0], rows.v[1]));
  const auto odd01 = pair(hn::InterleaveUpper(words, rows.v[0], rows.v[1]));
  const auto even23 = pair(hn::InterleaveLower(words, rows.v[2], rows.v[3]));
  const auto odd23 = pair(hn::InterleaveUpper(words, rows.v[2], rows.v[3]));
  const auto even0 = hn::BitCast(quads, hn::InterleaveLower(pairs, even01, even23));
  const auto even2 = hn::BitCast(quads, hn::InterleaveUpper(pairs, even01, even23));
  const auto odd0 = hn::BitCast(quads, hn::InterleaveLower(pairs, odd01, odd23));
  const auto odd2 = hn::BitCast(quads, hn::InterleaveUpper(pairs, odd01, odd23));
  return {{hn::BitCast(words, hn::InterleaveLower(quads, even0, odd0)),
           hn::BitCast(words, hn::InterleaveUpper(quads, even0, odd0)),
           hn::BitCast(words, hn::InterleaveLower(quads, even2, odd2)),
           hn::BitCast(words, hn::InterleaveUpper(quads, even2, odd2))}};
}

HWY_INLINE Rows forwardAcross(const Rows& rows) {
  const Vec a = hn::Add(rows.v[0], rows.v[3]);
  const Vec b = hn::Add(rows.v[1], rows.v[2]);
  const Vec c = hn::Sub(rows.v[1], rows.v[2]);
  const Vec d = hn::Sub(rows.v[0], rows.v[3]);
  return {{hn::Add(a, b), hn::Add(hn::Add(d, d), c), hn::Sub(a, b), hn::Sub(d, hn::Add(c, c))}};
}

/// Section 8.5.12.2, one direction.
HWY_INLINE Rows inverseAcross(const Rows& rows) {
  const Vec a = hn::Add(rows.v[0], rows.v[2]);
  const Vec b = hn::Sub(rows.v[0], rows.v[2]);
  const Vec c = hn::Sub(hn::ShiftRight<1>(rows.v[1]), rows.v[3]);
  const Vec d = hn::Add(rows.v[1], hn::ShiftRight<1>(rows.v[3]));
  return {{hn::Add(a, d), hn::Add(b, c), hn::Sub(b, c), hn::Sub(a, d)}};
}

/// Repeats four values for each block.
template <class Value>
HWY_INLINE hn::VFromD<hn::Rebind<Value, Values>> perBlock(const Value* four) {
  std::uint64_t bits = 0;
  std::memcpy(&bits, four, sizeof bits);
  return hn::BitCast(hn::Rebind<Value, Values>(), hn::Set(Quads(), bits));
}

HWY_INLINE Vec quantised(Vec coefficients, const std::uint16_t* factor, const std::uint16_t* bias) {
  const Values words;
  const Magnitudes magnitudes;
  const auto magnitude = hn::BitCast(magnitudes, hn::Abs(coefficients));
  const auto scaled = hn::MulHigh(hn::Add(magnitude, perBlock(bias)), perBlock(factor));
  const Vec level = hn::BitCast(words, hn::Min(scaled, hn::Set(magnitudes, kMaxLevel)));
  const Vec sign = hn::BroadcastSignBit(coefficients);
  return hn::Sub(hn::Xor(level, sign), sign);
}

/// Returns the coefficients of kBlocks blocks: by horizontal frequency, and in each block by vertical frequency.
HWY_INLINE Rows coefficientsOf(const std::uint8_t* source, const std::uint8_t* prediction) {
  const Values words;
  const Bytes bytes;
  Rows rows;
  for (std::ptrdiff_t y = 0; y < 4; ++y) {
    const std::ptrdiff_t at = y * MacroblockPixels::kStride;
    rows.v[y] = hn::Sub(hn::PromoteTo(words, hn::LoadU(bytes, source + at)),
                        hn::PromoteTo(words, hn::LoadU(bytes, prediction + at)));
  }
  return forwardAcross(transposed(forwardAcross(rows)));
}

/// Quantises kBlocks blocks. Returns bits of those that are not zero.
HWY_INLINE std::uint32_t quantiseBlocks(const Rows& coefficients, const Quantisation& by, bool withoutDc, Block* to,
                                        std::int16_t* dc) {
  const Quads quads;
  QuadVec levels[4];
  for (std::size_t x = 0; x < 4; ++x) {
    levels[x] = hn::BitCast(quads, quantised(coefficients.v[x], by.factor.data() + 4 * x, by.bias.data() + 4 * x));
  }
  if (withoutDc) {
    levels[0] = hn::AndNot(hn::Set(quads, 0xFFFF), levels[0]);
    HWY_ALIGN std::uint64_t first[kBlocks];
    hn::Store(hn::BitCast(quads, coefficients.v[0]), quads, first);
    for (int i = 0; i < kBlocks; ++i) dc[i] = static_cast<std::int16_t>(first[i] & 0xFFFF);
  }
  const QuadVec any = hn::Or(hn::Or(levels[0], levels[1]), hn::Or(levels[2], levels[3]));
  const auto zero = hn::Zero(quads);
  auto* const places = reinterpret_cast<std::uint64_t*>(to);
  if (hn::AllTrue(quads, hn::Eq(any, zero))) {
    for (int i = 0; i < 4; ++i) hn::Store(zero, quads, places + i * kBlocks);
    return 0;
  }
  hn::StoreInterleaved4(levels[0], levels[1], levels[2], levels[3], quads, places);
  HWY_ALIGN std::uint64_t ofBlock[kBlocks];
  hn::Store(any, quads, ofBlock);
  std::uint32_t blocks = 0;
  for (int i = 0; i < kBlocks; ++i) {
    if (ofBlock[i] != 0) blocks |= 1U << i;
  }
  return blocks;
}

void quantiseLuma(const MacroblockPixels& source, const MacroblockPixels& prediction, const Quantisation& quantisation,
                  bool withoutDc, Residual& to) {
  to.lumaBlocks = 0;
  for (int block = 0; block < 16; block += kBlocks) {
    const std::ptrdiff_t at = block / 4 * 4 * MacroblockPixels::kStride + std::ptrdiff_t{block % 4} * 4;
    const auto index = static_cast<std::size_t>(block);
    to.lumaBlocks |= quantiseBlocks(coefficientsOf(source.luma.data() + at, prediction.luma.data() + at), quantisation,
                                    withoutDc, &to.luma[index], &to.lumaDc[index])
                     << block;
  }
  findLevelBits(to.lumaBlocks, to.luma.data(), to.lumaBits.data());
}

/// The places in a Residual of the blocks of a row of chroma's pixels: two of U, two of V.
constexpr std::size_t kChromaPlaces[2][4] = {{0, 1, 4, 5}, {2, 3, 6, 7}};

void quantiseChroma(const MacroblockPixels& source, const MacroblockPixels& prediction,
                    const Quantisation& quantisation, Residual& to) {
  to.chromaBlocks = 0;
  for (int row = 0; row < 2; ++row) {
    for (int column = 0; column < 4; column += kBlocks) {
      const std::ptrdiff_t at = row * 4 * MacroblockPixels::kStride + std::ptrdiff_t{column} * 4;
      HWY_ALIGN Block blocks[kBlocks];
      std::int16_t dc[kBlocks];
      const std::uint32_t coded = quantiseBlocks(
          coefficientsOf(source.chroma.data() + at, prediction.chroma.data() + at), quantisation, true, blocks, dc);
      for (int i = 0; i < kBlocks; ++i) {
        const std::size_t place = kChromaPlaces[row][column + i];
        to.chroma[place] = blocks[i];
        to.chromaDc[place] = dc[i];
        to.chromaBlocks |= (coded >> i & 1U) << place;
      }
    }
  }
  findLevelBits(to.chromaBlocks, to.chroma.data(), to.chromaBits.data());
}

/// Restores kBlocks blocks: returns what is to be added to their four rows of pixels.
HWY_INLINE Rows restored(const Block* blocks, const Quantisation& by, const std::int16_t* dc) {
  const Values words;
  const Quads quads;
  QuadVec levels[4];
  hn::LoadInterleaved4(quads, reinterpret_cast<const std::uint64_t*>(blocks), levels[0], levels[1], levels[2],
                       levels[3]);
  Rows coefficients;
  for (std::size_t x = 0; x < 4; ++x) {
    coefficients.v[x] = hn::Mul(hn::BitCast(words, levels[x]), perBlock(by.scale.data() + 4 * x));
  }
  if (dc != nullptr) {
    HWY_ALIGN std::uint64_t first[kBlocks];
    for (int i = 0; i < kBlocks; ++i) first[i] = static_cast<std::uint16_t>(dc[i]);
    const auto others = hn::AndNot(hn::Set(quads, 0xFFFF), hn::BitCast(quads, coefficients.v[0]));
    coefficients.v[0] = hn::BitCast(words, hn::Or(others, hn::Load(quads, first)));
  }
  Rows rows = inverseAcross(transposed(inverseAcross(coefficients)));
  for (Vec& row : rows.v) row = hn::ShiftRight<6>(hn::Add(row, hn::Set(words, 32)));
  return rows;
}

HWY_INLINE hn::Vec<Bytes> sumOf(const std::uint8_t* prediction, Vec added) {
  const auto sum = hn::Add(hn::PromoteTo(Values(), hn::LoadU(Bytes(), prediction)), added);
  return hn::DemoteTo(Bytes(), sum);
}

void restoreLuma(const Residual& residual, const Quantisation& quantisation, const std::int16_t* dc,
                 const MacroblockPixels& prediction, const PixelRows& to) {
  for (int block = 0; block < 16; block += kBlocks) {
    const int top = block / 4 * 4;
    const int left = block % 4 * 4;
    const auto index = static_cast<std::size_t>(block);
    const bool isCoded = dc != nullptr || (residual.lumaBlocks >> block & ((1U << kBlocks) - 1)) != 0;
    Rows added{{hn::Zero(Values()), hn::Zero(Values()), hn::Zero(Values()), hn::Zero(Values())}};
    if (isCoded) added = restored(&residual.luma[index], quantisation, dc == nullptr ? nullptr : dc + index);
    for (int y = 0; y < 4; ++y) {
      const std::uint8_t* const from = prediction.luma.data() + (top + y) * MacroblockPixels::kStride + left;
      hn::StoreU(sumOf(from, added.v[y]), Bytes(), to.first + (top + y) * to.stride + left);
    }
  }
}

void restoreChroma(const Residual& residual, const Quantisation& quantisation, const std::int16_t* dc,
                   const MacroblockPixels& prediction, const PixelRows& u, const PixelRows& v) {
  for (int row = 0; row < 2; ++row) {
    for (int column = 0; column < 4; column += kBlocks) {
      HWY_ALIGN Block blocks[kBlocks];
      std::int16_t first[kBlocks];
      for (int i = 0; i < kBlocks; ++i) {
        blocks[i] = residual.chroma[kChromaPlaces[row][column + i]];
        first[i] = dc[kChromaPlaces[row][column + i]];
      }
      const Rows added = restored(blocks, quantisation, first);
      for (int y = 0; y < 4; ++y) {
        const std::ptrdiff_t line = row * 4 + y;
        std::uint8_t pixels[kLanes];
        hn::StoreU(sumOf(prediction.chroma.data() + line * MacroblockPixels::kStride + column * 4, added.v[y]), Bytes(),
                   pixels);
        if (column == 0) std::memcpy(u.first + line * u.stride, pixels, 8);
        if (column + kBlocks == 4) std::memcpy(v.first + line * v.stride, pixels + kLanes - 8, 8);
      }
    }
  }
}

}  // namespace grove::stream::h264::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace grove::stream::h264 {

HWY_EXPORT(quantiseLuma);
HWY_EXPORT(quantiseChroma);
HWY_EXPORT(restoreLuma);
HWY_EXPORT(restoreChroma);

void quantiseLuma(const MacroblockPixels& source, const MacroblockPixels& prediction, const Quantisation& quantisation,
                  bool withoutDc, Residual& to) {
  HWY_DYNAMIC_DISPATCH(quantiseLuma)(source, prediction, quantisation, withoutDc, to);
}

void quantiseChroma(const MacroblockPixels& source, const MacroblockPixels& prediction,
                    const Quantisation& quantisation, Residual& to) {
  HWY_DYNAMIC_DISPATCH(quantiseChroma)(source, prediction, quantisation, to);
}

void restoreLuma(const Residual& residual, const Quantisation& quantisation, const std::int16_t* dc,
                 const MacroblockPixels& prediction, const PixelRows& to) {
  HWY_DYNAMIC_DISPATCH(restoreLuma)(residual, quantisation, dc, prediction, to);
}

void restoreChroma(const Residual& residual, const Quantisation& quantisation, const std::int16_t* dc,
                   const MacroblockPixels& prediction, const PixelRows& u, const PixelRows& v) {
  HWY_DYNAMIC_DISPATCH(restoreChroma)(residual, quantisation, dc, prediction, u, v);
}

}  // namespace grove::stream::h264

#endif  // HWY_ONCE
