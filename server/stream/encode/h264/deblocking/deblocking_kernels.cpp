#include "stream/encode/h264/deblocking/deblocking_kernels.h"

#include <array>
#include <cstddef>
#include <cstdint>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "stream/encode/h264/deblocking/deblocking_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "stream/encode/h264/deblocking/deblocking_samples_inl.h"

HWY_BEFORE_NAMESPACE();
namespace grove::stream::h264::HWY_NAMESPACE {

using HalfBytes = hn::Half<Bytes>;

/// Pixels of an edge, and bytes of a vector.
constexpr std::size_t kPixels = 16;
/// Vertical edges are filtered in strips of 16 rows and that many columns.
constexpr std::size_t kStrip = 8;

/// Which quarter of an edge each byte belongs to.
HWY_ALIGN constexpr std::uint8_t kLumaQuarters[kPixels] = {0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3};
HWY_ALIGN constexpr std::uint8_t kChromaQuarters[kPixels] = {0, 0, 1, 1, 2, 2, 3, 3, 0, 0, 1, 1, 2, 2, 3, 3};

HWY_INLINE ByteVec everyWord(std::uint32_t word) {
  return hn::BitCast(Bytes(), hn::Set(hn::Repartition<std::uint32_t, Bytes>(), word));
}

/// One edge: 16 pixels of luma, or 8 of U and 8 of V.
struct Edge {
  Strengths strengths;
  DeblockingLimits limits;

  [[nodiscard]] HWY_INLINE bool isFiltered() const { return strengths != 0 && limits.alpha != 0; }
  /// All strengths are 4 then.
  [[nodiscard]] HWY_INLINE bool isStrong() const { return strengths == 0x04040404U; }
  [[nodiscard]] HWY_INLINE Thresholds thresholds() const { return {every(limits.alpha), every(limits.beta)}; }
  [[nodiscard]] HWY_INLINE ByteVec smallStep() const { return every(limits.alpha / 4 + 2); }
  /// Each pixel's, where no strength is 4.
  [[nodiscard]] HWY_INLINE ByteVec clips(const std::uint8_t* quarters) const {
    const auto each = hn::TableLookupBytes(everyWord(strengths), hn::Load(Bytes(), quarters));
    return hn::TableLookupBytes(everyWord(limits.clips), each);
  }
};

/// A macroblock's edges of one direction.
struct Edges {
  std::array<Edge, 4> luma;
  std::array<Edge, 2> chroma;

  HWY_INLINE Edges(const std::array<Strengths, 4>& strengths, const EdgeLimits& border, const EdgeLimits& inside)
      : luma{Edge{strengths[0], border.luma}, Edge{strengths[1], inside.luma}, Edge{strengths[2], inside.luma},
             Edge{strengths[3], inside.luma}},
        chroma{Edge{strengths[0], border.chroma}, Edge{strengths[2], inside.chroma}} {}
};

/// `q0`: where the 16 pixels on the edge's right or lower side begin, side by side. `step` leads away from the edge.
HWY_INLINE void filterLumaEdge(const Edge& edge, std::uint8_t* q0, std::ptrdiff_t step) {
  const Bytes bytes;
  const auto load = [&](std::ptrdiff_t i) { return hn::LoadU(bytes, q0 + i * step); };
  const auto store = [&](ByteVec value, std::ptrdiff_t i) { hn::StoreU(value, bytes, q0 + i * step); };
  if (edge.isStrong()) {
    LumaSide p = {{load(-1), load(-2), load(-3), load(-4)}};
    LumaSide q = {{load(0), load(1), load(2), load(3)}};
    smoothLuma(p, q, edge.smallStep(), edge.thresholds());
    for (std::ptrdiff_t i = 0; i < 3; ++i) {
      store(p.pixels[i], -1 - i);
      store(q.pixels[i], i);
    }
  } else {
    ByteVec p[2] = {load(-1), load(-2)};
    ByteVec q[2] = {load(0), load(1)};
    filterLuma(load(-3), p[1], p[0], q[0], q[1], load(2), edge.clips(kLumaQuarters), edge.thresholds());
    for (std::ptrdiff_t i = 0; i < 2; ++i) {
      store(p[i], -1 - i);
      store(q[i], i);
    }
  }
}

/// `lines`: p1, p0, q0, q1, each 8 pixels of U and then of V.
HWY_INLINE void filterChromaEdge(const Edge& edge, ByteVec* lines) {
  if (edge.isStrong()) {
    smoothChroma(lines[0], lines[1], lines[2], lines[3], edge.thresholds());
  } else {
    filterChroma(lines[0], lines[1], lines[2], lines[3], edge.clips(kChromaQuarters), edge.thresholds());
  }
}

/// 8 vectors of 16 bytes: all that a strip has.
struct Strip {
  ByteVec vectors[kStrip];
};

/// Interleaves the bytes of both halves of a strip. Seen as 16 rows of 8 columns, a byte's number has 4 bits of row and
/// 3 bits of column; this moves its highest bit to the lowest place. So four times transposes the strip to 8 rows of 16
/// columns, and three times more transposes it back.
HWY_INLINE void riffle(Strip& strip) {
  Strip to;
  for (std::size_t i = 0; i < kStrip / 2; ++i) {
    to.vectors[2 * i] = hn::InterleaveLower(Bytes(), strip.vectors[i], strip.vectors[i + kStrip / 2]);
    to.vectors[2 * i + 1] = hn::InterleaveUpper(Bytes(), strip.vectors[i], strip.vectors[i + kStrip / 2]);
  }
  strip = to;
}

/// A strip's columns. `rowAt`: where each of its 16 rows begins.
template <typename RowAt>
HWY_INLINE Strip loadColumns(RowAt rowAt) {
  const auto row = [&](std::size_t y) { return hn::ZeroExtendVector(Bytes(), hn::LoadU(HalfBytes(), rowAt(y))); };
  Strip strip;
  // Does the first of four steps, too.
  for (std::size_t i = 0; i < kStrip; ++i) {
    strip.vectors[i] = hn::InterleaveLower(Bytes(), row(i), row(i + kStrip));
  }
  for (int step = 1; step < 4; ++step) riffle(strip);
  return strip;
}

template <typename RowAt>
HWY_INLINE void storeColumns(Strip strip, RowAt rowAt) {
  for (int step = 0; step < 3; ++step) riffle(strip);
  for (std::size_t i = 0; i < kStrip; ++i) {
    hn::StoreU(hn::LowerHalf(HalfBytes(), strip.vectors[i]), HalfBytes(), rowAt(2 * i));
    hn::StoreU(hn::UpperHalf(HalfBytes(), strip.vectors[i]), HalfBytes(), rowAt(2 * i + 1));
  }
}

HWY_INLINE void filterVerticalLuma(const std::array<Edge, 4>& edges, std::uint8_t* luma, std::ptrdiff_t stride) {
  const auto filters = [&](std::size_t edge) { return edges[edge].isFiltered(); };
  // The strips begin 8 pixels left of the macroblock. The edges with even numbers are between two of them.
  constexpr std::size_t kStrips = 3;
  const bool needed[kStrips] = {filters(0), filters(0) || filters(1) || filters(2), filters(2) || filters(3)};
  HWY_ALIGN std::uint8_t columns[kStrips * kStrip * kPixels];
  const auto rowsOf = [&](std::size_t strip) {
    std::uint8_t* const first = luma + strip * kStrip - kStrip;
    return [first, stride](std::size_t y) { return first + static_cast<std::ptrdiff_t>(y) * stride; };
  };
  const auto columnsOf = [&](std::size_t strip) { return columns + strip * kStrip * kPixels; };
  for (std::size_t s = 0; s < kStrips; ++s) {
    if (!needed[s]) continue;
    const Strip strip = loadColumns(rowsOf(s));
    for (std::size_t i = 0; i < kStrip; ++i) hn::Store(strip.vectors[i], Bytes(), columnsOf(s) + i * kPixels);
  }
  for (std::size_t e = 0; e < edges.size(); ++e) {
    if (filters(e)) filterLumaEdge(edges[e], columns + (kStrip + 4 * e) * kPixels, kPixels);
  }
  for (std::size_t s = 0; s < kStrips; ++s) {
    if (!needed[s]) continue;
    Strip strip;
    for (std::size_t i = 0; i < kStrip; ++i) strip.vectors[i] = hn::Load(Bytes(), columnsOf(s) + i * kPixels);
    storeColumns(strip, rowsOf(s));
  }
}

HWY_INLINE void filterVerticalChroma(const std::array<Edge, 2>& edges, const MacroblockPlace& pixels) {
  if (!edges[0].isFiltered() && !edges[1].isFiltered()) return;
  // Beginning 2 pixels left of the macroblock, one strip contains what both edges need.
  const auto rowAt = [&](std::size_t y) {
    return pixels.chroma[y / 8] + static_cast<std::ptrdiff_t>(y % 8) * pixels.chromaStride - 2;
  };
  Strip strip = loadColumns(rowAt);
  for (std::size_t e = 0; e < edges.size(); ++e) {
    if (edges[e].isFiltered()) filterChromaEdge(edges[e], strip.vectors + 4 * e);
  }
  storeColumns(strip, rowAt);
}

HWY_INLINE void filterHorizontalLuma(const std::array<Edge, 4>& edges, std::uint8_t* luma, std::ptrdiff_t stride) {
  for (std::size_t e = 0; e < edges.size(); ++e) {
    if (edges[e].isFiltered()) filterLumaEdge(edges[e], luma + static_cast<std::ptrdiff_t>(4 * e) * stride, stride);
  }
}

HWY_INLINE void filterHorizontalChroma(const std::array<Edge, 2>& edges, const MacroblockPlace& pixels) {
  const HalfBytes half;
  for (std::size_t e = 0; e < edges.size(); ++e) {
    if (!edges[e].isFiltered()) continue;
    const auto offset = [&](std::size_t i) {
      return (static_cast<std::ptrdiff_t>(4 * e + i) - 2) * pixels.chromaStride;
    };
    ByteVec lines[4];
    for (std::size_t i = 0; i < 4; ++i) {
      lines[i] = hn::Combine(Bytes(), hn::LoadU(half, pixels.chroma[1] + offset(i)),
                             hn::LoadU(half, pixels.chroma[0] + offset(i)));
    }
    filterChromaEdge(edges[e], lines);
    for (std::size_t i = 1; i < 3; ++i) {
      hn::StoreU(hn::LowerHalf(half, lines[i]), half, pixels.chroma[0] + offset(i));
      hn::StoreU(hn::UpperHalf(half, lines[i]), half, pixels.chroma[1] + offset(i));
    }
  }
}

void filterEdges(const FilteredEdges& edges, const MacroblockPlace& pixels) {
  const Edges vertical(edges.strengths.vertical, edges.left, edges.inside);
  const Edges horizontal(edges.strengths.horizontal, edges.above, edges.inside);
  // Alternates planes, because loads of rows wait for just stored parts of them: 8 % faster.
  filterVerticalChroma(vertical.chroma, pixels);
  filterVerticalLuma(vertical.luma, pixels.luma, pixels.lumaStride);
  filterHorizontalChroma(horizontal.chroma, pixels);
  filterHorizontalLuma(horizontal.luma, pixels.luma, pixels.lumaStride);
}

}  // namespace grove::stream::h264::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace grove::stream::h264 {

HWY_EXPORT(filterEdges);

void filterEdges(const FilteredEdges& edges, const MacroblockPlace& pixels) {
  HWY_DYNAMIC_DISPATCH(filterEdges)(edges, pixels);
}

}  // namespace grove::stream::h264

#endif  // HWY_ONCE
