#include "raster/shading/detail_kernels.h"

#include <algorithm>
#include <cstring>

#include "raster/shading/vertex_light.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "raster/shading/detail_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "base/simd/lanes_inl.h"

HWY_BEFORE_NAMESPACE();
namespace grove::raster::HWY_NAMESPACE {

using namespace simd::HWY_NAMESPACE;  // NOLINT(google-build-using-namespace): one word for each operation
using world::Vec3;

static_assert(kLanes <= static_cast<int>(kFragmentRoom));

/// Smaller features are skipped.
constexpr float kMinPixels = 0.9F;
/// Added to a float of 0..2^22, it leaves the nearest whole number in the lowest bits.
constexpr float kWholeBits = 8388608.0F;

/// A point per lane.
struct Place {
  Floats x;
  Floats y;
  Floats z;
};

HWY_INLINE Floats dot(Vec3 a, const Place& b) { return mulAdd(a.x, b.x, mulAdd(a.y, b.y, Floats(a.z) * b.z)); }

HWY_INLINE Ints bitsOf(Floats value) { return Ints(hn::BitCast(IntTag(), value.raw)); }

template <int kShift>
HWY_INLINE Floats byteOf(Ints packed) {
  return toFloats(shiftRight<kShift>(packed) & 0xFF);
}

/// Brightens a display-encoded channel by a factor exp(change) of its light: the display curve is steepest in its
/// middle. The result's low bits are the whole number; the upper bits are undefined.
HWY_INLINE Ints graded(Floats channel, Floats change) {
  const Floats more = channel * (Floats(285.0F) - channel) * (0.55F / 285.0F);
  return bitsOf(clamp(mulAdd(more, change, channel), 0.0F, 255.0F) + kWholeBits);
}

/// Batches pixels of many rows, because drawings are narrow and vectors are wide.
class Weathering {
 public:
  Weathering(const DetailView& view, const std::uint32_t* squares, Image& image)
      : view_(view), squares_(squares), image_(image) {}

  /// `surface` and `reversed` begin at the row's first column.
  void addRow(int row, Span span, const std::uint32_t* surface, const float* reversed) {
    while (span.begin < span.end) {
      if (count_ == kBlock || pieces_ == kPieces) flush();
      const int count = std::min(span.end - span.begin, kBlock - count_);
      take(row, span.begin, count, surface + span.begin, reversed + span.begin);
      piece_[pieces_++] = {row, span.begin, count};
      count_ += count;
      span.begin += count;
    }
  }

  /// Writes the pixels added since the last flush.
  void flush() {
    // The last vector may extend beyond initialised pixels.
    store(Floats(0.0F), reversed_ + count_);
    Floats nearest;
    for (int i = 0; i < count_; i += kLanes) {
      nearest = max(nearest, load(reversed_ + i));
      store(Floats(0.0F), stain_ + i);
      store(Floats(0.0F), slope_ + i);
    }
    const float nearestOfAll = maxOf(nearest);
    for (const DetailScale& scale : view_.scales) {
      if (scale.pixels * nearestOfAll <= kMinPixels * view_.nearDepth) continue;
      locate(scale);
      lookUp();
      addScale(scale);
    }
    for (int i = 0; i < count_; i += kLanes) grade(i);
    int at = 0;
    for (int i = 0; i < pieces_; ++i) {
      const Piece& piece = piece_[i];
      const auto count = static_cast<std::size_t>(piece.count);
      std::memcpy(image_.colourRow(piece.row) + piece.column, surface_ + at, count * sizeof(std::uint32_t));
      std::memcpy(image_.depthRow(piece.row) + piece.column, depth_ + at, count * sizeof(float));
      at += piece.count;
    }
    pieces_ = 0;
    count_ = 0;
  }

 private:
  /// Adjacent pixels of one row in the block.
  struct Piece {
    int row;
    int column;
    int count;
  };
  static constexpr int kBlock = 256;
  static constexpr int kPieces = 32;
  static constexpr int kRoom = kBlock + static_cast<int>(kFragmentRoom);  // whole vectors are written at any place

  /// Adds pixels to the block in whole vectors; the next call overwrites the excess.
  HWY_INLINE void take(int row, int column, int count, const std::uint32_t* surface, const float* reversed) {
    const Vec3 left =
        view_.corner + view_.downwards * static_cast<float>(row) + view_.alongRow * static_cast<float>(column);
    const Vec3 right = view_.alongRow;
    const Vec3 eye = view_.eye;
    const Floats near = view_.nearDepth;
    for (int i = 0, to = count_; i < count; i += kLanes, to += kLanes) {
      const Floats depth = load(reversed + i);
      store(load(surface + i), surface_ + to);
      store(depth, reversed_ + to);
      // Empty pixels are treated as near ones, so that look-ups stay within integer range.
      const Floats metres = near / select(depth > 0.0F, depth, 1.0F);
      store(metres, depth_ + to);
      const Floats along = toFloats(upwards() + i);
      store(mulAdd(metres, mulAdd(along, right.x, left.x), eye.x), x_ + to);
      store(mulAdd(metres, mulAdd(along, right.y, left.y), eye.y), y_ + to);
      store(mulAdd(metres, mulAdd(along, right.z, left.z), eye.z), z_ + to);
    }
  }

  /// Computes the cells of a scale and the positions within them.
  HWY_INLINE void locate(const DetailScale& scale) {
    constexpr auto kBits = static_cast<int>(DetailTexture::kBits);
    constexpr std::int32_t kWrap = DetailTexture::kSize - 1;
    static_assert(DetailTexture::kLine == DetailTexture::kSize + 1);
    // A sum with this has signed whole numbers in its lowest bits.
    constexpr float kSignedBits = 12582912.0F;
    for (int i = 0; i < count_; i += kLanes) {
      const Place place{load(x_ + i), load(y_ + i), load(z_ + i)};
      const Floats u = dot(scale.texelX, place);
      const Floats v = dot(scale.texelY, place);
      const Floats w = dot(scale.texelZ, place);
      const Floats cellU = floor(u);
      const Floats cellV = floor(v);
      const Floats cellW = floor(w);
      store(u - cellU, u_ + i);
      store(v - cellV, v_ + i);
      store(w - cellW, w_ + i);
      const Ints line = shiftLeft<kBits>(bitsOf(cellV + kSignedBits) & kWrap) + (bitsOf(cellU + kSignedBits) & kWrap);
      store(shiftLeft<kBits>(line) + line + (bitsOf(cellW + kSignedBits) & kWrap), at_ + i);
    }
  }

  /// Two neighbours at once, one pixel after the other.
  HWY_INLINE void lookUp() {
    const std::uint32_t* squares = squares_;
    const int count = count_;
    for (int i = 0; i < count; ++i) std::memcpy(pairs_ + 2 * i, squares + at_[i], 2 * sizeof(std::uint32_t));
  }

  /// Adds one scale: trilinear interpolation with gradient.
  HWY_INLINE void addScale(const DetailScale& scale) {
    const hn::RebindToUnsigned<IntTag> bits;
    const float pixels = scale.pixels / view_.nearDepth;
    for (int i = 0; i < count_; i += kLanes) {
      hn::Vec<hn::RebindToUnsigned<IntTag>> both[2];
      hn::LoadInterleaved2(bits, pairs_ + 2 * i, both[0], both[1]);
      const Ints front(hn::BitCast(IntTag(), both[0]));
      const Ints back(hn::BitCast(IntTag(), both[1]));
      const Floats fu = load(u_ + i);
      const Floats fv = load(v_ + i);
      const Floats fw = load(w_ + i);
      const Floats c00 = byteOf<0>(front);
      const Floats c10 = byteOf<8>(front);
      const Floats c01 = byteOf<16>(front);
      const Floats c11 = byteOf<24>(front);
      const Floats w00 = byteOf<0>(back) - c00;
      const Floats w10 = byteOf<8>(back) - c10;
      const Floats w01 = byteOf<16>(back) - c01;
      const Floats w11 = byteOf<24>(back) - c11;
      const Floats h00 = mulAdd(fw, w00, c00);
      const Floats h01 = mulAdd(fw, w01, c01);
      const Floats u0 = mulAdd(fw, w10, c10) - h00;
      const Floats u1 = mulAdd(fw, w11, c11) - h01;
      const Floats low = mulAdd(fu, u0, h00);
      const Floats slopeU = mulAdd(fv, u1 - u0, u0);
      const Floats slopeV = mulAdd(fu, u1, h01) - low;
      const Floats lowW = mulAdd(fu, w10 - w00, w00);
      const Floats slopeW = mulAdd(fv, mulAdd(fu, w11 - w01, w01) - lowW, lowW);
      const Floats weight = clamp(mulAdd(load(reversed_ + i), pixels, -kMinPixels), 0.0F, 1.0F);
      const Floats relief = reliefOf(load(surface_ + i));
      const Floats slope = mulAdd(
          slopeU, mulAdd(relief, scale.sun.x, scale.up.x),
          mulAdd(slopeV, mulAdd(relief, scale.sun.y, scale.up.y), slopeW * mulAdd(relief, scale.sun.z, scale.up.z)));
      store(mulAdd(mulAdd(fv, slopeV, low) - 127.5F, weight * scale.stain, load(stain_ + i)), stain_ + i);
      store(load(slope_ + i) - slope * weight, slope_ + i);
    }
  }

  /// The surface's relief by sunlight.
  static HWY_INLINE Floats reliefOf(Ints surface) { return toFloats(shiftRight<28>(surface)) * (kMaxRelief / 15.0F); }

  /// Turns surface into colour and skips the depth of empty pixels.
  HWY_INLINE void grade(int i) {
    const Ints packed = load(surface_ + i);
    const Floats lichen = toFloats(shiftRight<24>(packed) & 0xF) * (1.0F / 15.0F);
    const Floats stain = load(stain_ + i);
    const Floats change = clamp(stain + load(slope_ + i), -0.9F, 0.8F);
    const Floats overgrown = clamp((mulAdd(stain, 1.1F, lichen) - 0.42F) * 6.0F, 0.0F, 1.0F);
    const Floats warm = stain * 0.22F;
    const Ints red = graded(byteOf<0>(packed), mulAdd(overgrown, 0.26F, change) + warm);
    const Ints green = graded(byteOf<8>(packed), mulAdd(overgrown, 0.34F, change));
    const Ints blue = graded(byteOf<16>(packed), mulAdd(overgrown, 0.06F, change) - warm);
    const Mask covered = load(reversed_ + i) > 0.0F;
    const Ints colour =
        (red & 0xFF) | shiftLeft<8>(green & 0xFF) | shiftLeft<16>(blue) | static_cast<std::int32_t>(0xFF000000U);
    store(onlyWhere(covered, colour), surface_ + i);
    store(select(covered, load(depth_ + i), world::kInfiniteDepth), depth_ + i);
  }

  const DetailView& view_;
  const std::uint32_t* squares_;
  Image& image_;
  Piece piece_[kPieces];
  int pieces_ = 0;
  int count_ = 0;
  HWY_ALIGN std::uint32_t surface_[kRoom];
  HWY_ALIGN float reversed_[kRoom];
  HWY_ALIGN float depth_[kRoom];
  // In object coordinates.
  HWY_ALIGN float x_[kRoom];
  HWY_ALIGN float y_[kRoom];
  HWY_ALIGN float z_[kRoom];
  // Indices and results of a scale's look-ups: two neighbours per pixel.
  HWY_ALIGN std::int32_t at_[kRoom];
  HWY_ALIGN float u_[kRoom];
  HWY_ALIGN float v_[kRoom];
  HWY_ALIGN float w_[kRoom];
  HWY_ALIGN std::uint32_t pairs_[2 * kRoom];
  // Sums over the scales: the height, and the brightening by slope.
  HWY_ALIGN float stain_[kRoom];
  HWY_ALIGN float slope_[kRoom];
};

void finishWeathered(const Fragments& fragments, const DetailView& view, const std::uint32_t* squares, Image& image) {
  Weathering weathering(view, squares, image);
  for (int row = 0; row < image.height(); ++row) {
    const std::ptrdiff_t start = row * fragments.stride;
    weathering.addRow(row, image.span(row), fragments.surface + start, fragments.depth + start);
  }
  weathering.flush();
}

void finishPlain(const Fragments& fragments, float nearDepth, Image& image) {
  for (int row = 0; row < image.height(); ++row) {
    const Span span = image.span(row);
    const std::uint32_t* __restrict surface = fragments.surface + row * fragments.stride;
    const float* __restrict reversed = fragments.depth + row * fragments.stride;
    std::uint32_t* __restrict colour = image.colourRow(row);
    float* __restrict depth = image.depthRow(row);
    for (int x = span.begin; x < span.end; ++x) {
      const bool covered = reversed[x] > 0.0F;
      colour[x] = covered ? surface[x] | 0xFF000000U : 0U;
      depth[x] = covered ? nearDepth / reversed[x] : world::kInfiniteDepth;
    }
  }
}

}  // namespace grove::raster::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace grove::raster {

HWY_EXPORT(finishWeathered);
HWY_EXPORT(finishPlain);

void finishWeathered(const Fragments& fragments, const DetailView& view, const std::uint32_t* squares, Image& image) {
  HWY_DYNAMIC_DISPATCH(finishWeathered)(fragments, view, squares, image);
}

void finishPlain(const Fragments& fragments, float nearDepth, Image& image) {
  HWY_DYNAMIC_DISPATCH(finishPlain)(fragments, nearDepth, image);
}

}  // namespace grove::raster

#endif  // HWY_ONCE
