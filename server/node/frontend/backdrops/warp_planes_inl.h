// Colours of a warped backdrop, plane by plane. For kernels: included once per target.

#if defined(GROVE_NODE_FRONTEND_BACKDROPS_WARP_PLANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef GROVE_NODE_FRONTEND_BACKDROPS_WARP_PLANES_INL_H
#undef GROVE_NODE_FRONTEND_BACKDROPS_WARP_PLANES_INL_H
#else
#define GROVE_NODE_FRONTEND_BACKDROPS_WARP_PLANES_INL_H
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "node/frontend/backdrops/backdrop_kernels.h"
#include "node/frontend/backdrops/warp_places_inl.h"

HWY_BEFORE_NAMESPACE();
namespace grove::node::HWY_NAMESPACE {

// A cell's row is 8 bytes of samples: 8 of luma, or 4 of both chroma. Registers hold one word for each, and those of
// several cells.
using WordTag = hn::CappedTag<std::int16_t, 32>;
using ByteTag = hn::RepartitionToNarrow<hn::RebindToUnsigned<WordTag>>;
using Words = hn::Vec<WordTag>;
using Bytes = hn::Vec<ByteTag>;
inline constexpr int kCellsAtOnce = static_cast<int>(hn::MaxLanes(WordTag())) / 8;
static_assert(kWarpCells % kCellsAtOnce == 0 && kCellGroup % kCellsAtOnce == 0);

/// Sums of neighbouring products: weights up to 255 times values from -128 to 127.
HWY_INLINE Words sumOfPairs(Words weights, Bytes values) {
#if HWY_TARGET == HWY_AVX3
  return Words{_mm512_maddubs_epi16(weights.raw, values.raw)};
#elif HWY_TARGET == HWY_AVX2
  return Words{_mm256_maddubs_epi16(weights.raw, values.raw)};
#elif HWY_TARGET == HWY_SSE4
  return Words{_mm_maddubs_epi16(weights.raw, values.raw)};
#else
  const WordTag tag;
  const Words both = hn::BitCast(tag, values);
  const Words first = hn::ShiftRight<8>(hn::ShiftLeft<8>(both));
  const Words low = hn::And(weights, hn::Set(tag, std::int16_t{0xFF}));
  return hn::Add(hn::Mul(first, low), hn::Mul(hn::ShiftRight<8>(both), hn::ShiftRight<8>(weights)));
#endif
}

/// 16 bytes from each of `from`.
HWY_INLINE Bytes loadBlocks(const std::uint8_t* plane, const std::int32_t* blocks) {
  const hn::FixedTag<std::uint8_t, 16> block;
  const auto at = [&](int cell) { return hn::LoadU(block, plane + blocks[cell]); };
#if HWY_MAX_BYTES >= 64
  const hn::Half<ByteTag> half;
  return hn::Combine(ByteTag(), hn::Combine(half, at(3), at(2)), hn::Combine(half, at(1), at(0)));
#elif HWY_MAX_BYTES >= 32
  return hn::Combine(ByteTag(), at(1), at(0));
#else
  return at(0);
#endif
}

HWY_INLINE Words word(int value) { return hn::Set(WordTag(), static_cast<std::int16_t>(value)); }

/// Numbers of a row's words: 0 to 7, in each cell.
HWY_INLINE Words placeInCell() { return hn::And(hn::Iota(WordTag(), 0), word(7)); }

/// Gives all words of a cell's row the cell's value in an array.
HWY_INLINE Words spread(const std::int16_t* ofCells) {
  alignas(64) static constexpr std::uint8_t kBytes[64] = {0, 1, 0, 1, 0, 1, 0, 1, 0, 1, 0, 1, 0, 1, 0, 1,  //
                                                          2, 3, 2, 3, 2, 3, 2, 3, 2, 3, 2, 3, 2, 3, 2, 3,  //
                                                          4, 5, 4, 5, 4, 5, 4, 5, 4, 5, 4, 5, 4, 5, 4, 5,  //
                                                          6, 7, 6, 7, 6, 7, 6, 7, 6, 7, 6, 7, 6, 7, 6, 7};
  return hn::TableLookupBytes(hn::LoadDup128(WordTag(), ofCells), hn::BitCast(WordTag(), hn::Load(ByteTag(), kBytes)));
}

/// Positions of the samples in their blocks.
template <int kSide>
HWY_INLINE Words placesOf(const std::int16_t* begin, const std::int16_t* step, int count) {
  const Words number = hn::ShiftRight < kSide == 8 ? 0 : 1 > (placeInCell());
  const Words place = hn::SaturatedAdd(spread(begin), hn::Mul(number, spread(step)));
  return hn::Min(hn::Max(place, hn::Zero(WordTag())), word(count * kPlaceSteps - 1));
}

/// Bilinear samples, one a word, of some cells from `first` on, in a plane whose lines are `stride` bytes.
template <int kSide>
HWY_INLINE Words samplesOf(const std::uint8_t* plane, std::ptrdiff_t stride, const RowPlaces<kSide>& places,
                           int first) {
  constexpr int kBytes = RowPlaces<kSide>::kBytes;
  const Words x = placesOf<kSide>(places.x + first, places.xStep + first, RowPlaces<kSide>::kBlock - 1);
  const Words y = placesOf<kSide>(places.y + first, places.yStep + first, 2);
  // Bytes of the sample and of the next one, and their weights, whose sum is 128.
  const Words chroma = kBytes == 1 ? hn::Zero(WordTag()) : hn::Mul(hn::And(placeInCell(), word(1)), word(257));
  const Words begin = hn::Add(chroma, word(256 * kBytes));
  const Words bytes = hn::Add(hn::Mul(hn::ShiftRight<kPlaceBits>(x), word(257 * kBytes)), begin);
  const Words right = hn::And(hn::ShiftRight<kPlaceBits - 7>(x), word(127));
  const Words weights = hn::Add(hn::Mul(right, word(255)), word(128));
  const auto line = [&](int number) {
    const Bytes blocks = loadBlocks(plane + number * stride, places.block + first);
    return hn::TableLookupBytes(blocks, hn::BitCast(ByteTag(), bytes));
  };
  const Bytes lines[3] = {line(0), line(1), line(2)};
  const auto isLower = hn::RebindMask(
      ByteTag(), hn::MaskFromVec(hn::BitCast(ByteTag(), hn::VecFromMask(hn::Gt(y, word(kPlaceSteps - 1))))));
  const auto mixed = [&](Bytes upper, Bytes lower) {
    const Bytes sign = hn::Set(ByteTag(), std::uint8_t{0x80});
    return sumOfPairs(weights, hn::Xor(hn::IfThenElse(isLower, lower, upper), sign));
  };
  const Words above = mixed(lines[0], lines[1]);
  const Words below = mixed(lines[1], lines[2]);
  const Words down = hn::ShiftLeft<15 - kPlaceBits>(hn::And(y, word(kPlaceSteps - kPlaceSteps / 128)));
  const Words sum = hn::Add(above, hn::MulFixedPoint15(hn::Sub(below, above), down));
  const hn::RebindToUnsigned<WordTag> bits;
  const auto rounded = hn::ShiftRight<7>(hn::BitCast(bits, hn::Add(sum, word(128 * 128 + 64))));
  return hn::BitCast(WordTag(), rounded);
}

/// One row of cells' samples, byte by byte. Prefetches what the cells below will probably read, because pieces of lines
/// are too short for the hardware prefetcher.
template <int kSide>
HWY_INLINE void warpRow(const std::uint8_t* plane, std::ptrdiff_t stride, const RowPlaces<kSide>& places, int count,
                        std::uint8_t* out) {
  constexpr int kCellsPerCacheLine = 64 / 8;
  const hn::Rebind<std::uint8_t, WordTag> bytes;
  for (int cell = 0; cell < count; cell += kCellsPerCacheLine) {
    __builtin_prefetch(plane + places.block[cell] + (kSide + 1) * stride);
  }
  for (int cell = 0; cell < count; cell += kCellsAtOnce) {
    hn::StoreU(hn::DemoteTo(bytes, samplesOf<kSide>(plane, stride, places, cell)), bytes, out + cell * 8);
  }
}

/// Colours of whole groups of cells. Returns a bit for each cell that is stretched too much and has no colours yet.
HWY_INLINE std::uint32_t warpGroups(WarpSource source, const CornerLine& above, const CornerLine& below, int count,
                                    WarpedPixels out) {
  std::uint32_t stretched = 0;
  // Finds all positions first: a load that spans two recent stores would wait for both (no store forwarding).
  RowPlaces<8> luma[8];
  for (int row = 0; row < 8; ++row) {
    const RowCorners corners(above, below, (static_cast<float>(row) + 0.5F) / 8.0F);
    stretched |= luma[row].find(corners, source.width, source.height);
  }
  RowPlaces<4> chroma[4];
  for (int row = 0; row < 4; ++row) {
    const RowCorners corners(above, below, (static_cast<float>(row) + 0.5F) / 4.0F);
    stretched |= chroma[row].find(corners, source.width / 2, source.height / 2);
  }
  for (int row = 0; row < 8; ++row) warpRow(source.y, source.width, luma[row], count, out.y + row * out.stride);
  alignas(64) std::uint8_t uv[4][8 * kWarpCells];
  for (int row = 0; row < 4; ++row) warpRow(source.uv, source.width, chroma[row], count, uv[row]);
  for (int row = 0; row < 4; ++row) {
    std::uint8_t* __restrict const u = out.u + row * (out.stride / 2);
    std::uint8_t* __restrict const v = out.v + row * (out.stride / 2);
    for (int i = 0; i < count * 4; ++i) {
      u[i] = uv[row][2 * i];
      v[i] = uv[row][2 * i + 1];
    }
  }
  return stretched;
}

}  // namespace grove::node::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // once per target
