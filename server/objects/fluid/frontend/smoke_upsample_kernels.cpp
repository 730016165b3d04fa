#include "objects/fluid/frontend/smoke_upsample_kernels.h"

#include <algorithm>
#include <array>
#include <cmath>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "objects/fluid/frontend/smoke_upsample_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "base/simd/lanes_inl.h"

HWY_BEFORE_NAMESPACE();
namespace grove::objects::fluid::HWY_NAMESPACE {

using namespace simd::HWY_NAMESPACE;

constexpr int kWidth = SmokeBlock::kWidth;
static_assert(kWidth % kLanes == 0);

/// Distance of a frame pixel from the centre of its target pixel, in target pixels.
template <int Scale>
constexpr float offset(int phase) {
  return (static_cast<float>(phase) + 0.5F) / static_cast<float>(Scale) - 0.5F;
}

/// Widens a row by Scale with linear interpolation, in whole vectors; in[-1] and the value after the last must exist.
template <int Scale>
HWY_INLINE void widen(const float* in, int count, float* out) {
  for (int x = 0; x < count; x += kLanes) {
    const Floats own = load(in + x);
    const Floats before = load(in + x - 1) - own;
    const Floats after = load(in + x + 1) - own;
    const auto at = [&](int phase) {
      const float far = offset<Scale>(phase);
      return far < 0.0F ? mulAdd(Floats(-far), before, own).raw : mulAdd(Floats(far), after, own).raw;
    };
    if constexpr (Scale == 2) {
      hn::StoreInterleaved2(at(0), at(1), FloatTag(), out + x * Scale);
    } else {
      hn::StoreInterleaved4(at(0), at(1), at(2), at(3), FloatTag(), out + x * Scale);
    }
  }
}

/// One pixel of the frame under smoke; the smoke's colour is in 255ths.
HWY_INLINE std::uint32_t under(std::uint32_t pixel, float red, float green, float blue, float clear) {
  const auto old = static_cast<std::int32_t>(pixel);
  const auto mix = [clear](std::int32_t byte, float add) {
    return static_cast<std::int32_t>(std::min(255.0F, static_cast<float>(byte) * clear + add + 0.5F));
  };
  const std::int32_t r = mix(old & 255, red);
  const std::int32_t g = mix((old >> 8) & 255, green);
  const std::int32_t b = mix((old >> 16) & 255, blue);
  return static_cast<std::uint32_t>((old & ~0xFFFFFF) | r | g << 8 | b << 16);
}

/// Blends smoke into a row of the frame between two widened rows, `share` of the way from one to the other. Channels
/// are `stride` apart.
HWY_INLINE void blend(const float* __restrict one, const float* __restrict other, std::ptrdiff_t stride, float share,
                      int count, std::uint32_t* __restrict colour) {
  for (int x = 0; x < count; ++x) {
    const auto mix = [&](int channel) {
      const float value = one[channel * stride + x];
      return value + share * (other[channel * stride + x] - value);
    };
    colour[x] = under(colour[x], mix(0), mix(1), mix(2), mix(3));
  }
}

/// Blends one target into a frame.
template <int Scale>
class Upsampling {
 public:
  Upsampling(const SmokePixels& pixels, const UpsampleRoom& room, float nearest, float farthest)
      : pixels_(pixels),
        room_(room),
        nearest_(nearest),
        farthest_(farthest),
        wideStride_(std::ptrdiff_t{pixels.blocksPerRow} * kWidth * Scale) {
    wideRows_.fill(-1);
  }

  /// Blends pixels first..last of the target's row `y` over Scale rows of the frame.
  void blendRow(int y, int first, int last, raster::Image& frame) {
    const int jumps = findJumps(y, first, last);
    const int left = (pixels_.rect.left + first) * Scale;
    const int width = std::min((last - first) * Scale, frame.width() - left);
    const std::ptrdiff_t begin = std::ptrdiff_t{first} * Scale;
    for (int phase = 0; phase < Scale; ++phase) {
      const int frameY = (pixels_.rect.top + y) * Scale + phase;
      if (frameY >= frame.height()) break;
      const float at = offset<Scale>(phase);
      const int otherY = std::clamp(at < 0.0F ? y - 1 : y + 1, 0, pixels_.rect.height() - 1);
      const float share = std::fabs(at);
      std::uint32_t* const colour = frame.colourRow(frameY) + left;
      // At depth jumps, blending restarts from the frame's own colours.
      for (int j = 0; j < jumps; ++j) {
        const int from = (room_.jumps[j] - first) * Scale;
        for (int i = 0; i < Scale; ++i) room_.kept[j * Scale + i] = colour[std::min(from + i, width - 1)];
      }
      blend(widened(y) + begin, widened(otherY) + begin, wideStride_, share, width, colour);
      const float* const depth = frame.depthRow(frameY) + left;
      for (int j = 0; j < jumps; ++j) {
        const int to = (room_.jumps[j] - first) * Scale;
        blendJump(room_.jumps[j], y, otherY, share, std::min(Scale, width - to), depth + to, room_.kept + j * Scale,
                  colour + to);
      }
    }
  }

 private:
  [[nodiscard]] const SmokeBlock& block(int b, int y) const { return pixels_.column(b)[y]; }

  /// The target's row `y` at the frame's width: red, green, blue (0..255), clear (0..1). Valid until two other rows are
  /// requested.
  const float* widened(int y) {
    const int slot = y % kWideRows;
    float* const row = room_.wide + slot * 4 * wideStride_;
    int& held = wideRows_[static_cast<std::size_t>(slot)];
    if (held == y) return row;
    held = y;
    const int width = pixels_.rect.width();
    // One more pixel at either end, for the neighbours of the first and the last.
    float* const line = room_.line + kWidth;
    constexpr std::array channels{&SmokeBlock::red, &SmokeBlock::green, &SmokeBlock::blue, &SmokeBlock::clear};
    for (std::size_t c = 0; c < channels.size(); ++c) {
      const Floats unit(c < 3 ? 255.0F : 1.0F);
      for (int x = 0; x < pixels_.blocksPerRow * kWidth; x += kLanes) {
        store(unit * load(block(x / kWidth, y).*channels[c] + x % kWidth), line + x);
      }
      line[-1] = line[0];
      line[width] = line[width - 1];
      widen<Scale>(line, pixels_.blocksPerRow * kWidth, row + static_cast<std::ptrdiff_t>(c) * wideStride_);
    }
    return row;
  }

  /// Writes the target's pixels first..last at depth jumps of a row to the scratch buffer; returns their number.
  int findJumps(int y, int first, int last) const {
    float* const low = room_.low + kWidth;
    float* const high = room_.high + kWidth;
    const int up = std::max(y - 1, 0);
    const int down = std::min(y + 1, pixels_.rect.height() - 1);
    for (int x = first / kWidth * kWidth; x < last; x += kLanes) {
      const SmokeBlock* const column = pixels_.column(x / kWidth);
      const Floats one = load(column[up].depth + x % kWidth);
      const Floats two = load(column[y].depth + x % kWidth);
      const Floats three = load(column[down].depth + x % kWidth);
      store(min(one, min(two, three)), low + x);
      store(max(one, max(two, three)), high + x);
    }
    for (float* const values : {low, high}) {
      values[first - 1] = values[first];
      values[last] = values[last - 1];
    }
    std::size_t count = 0;
    for (int x = first; x < last; x += kLanes) {
      const Floats nearest = min(load(low + x), min(load(low + x - 1), load(low + x + 1)));
      const Floats farthest = max(load(high + x), max(load(high + x - 1), load(high + x + 1)));
      // Smaller jumps also occur on plain ground, which rises within a few pixels.
      Mask jumping = farthest > mulAdd(Floats(1.08F), nearest, Floats(0.5F));
      jumping &= upwards() < Ints(last - x);
      if (!any(jumping)) continue;
      const Ints places = upwards() + Ints(x);
      count += hn::CompressStore(places.raw, hn::RebindMask(IntTag(), jumping.raw), IntTag(), room_.jumps + count);
    }
    return static_cast<int>(count);
  }

  /// A weighted sum of the target's pixels.
  struct Sample {
    float weight = 0.0F;
    float red = 0.0F;
    float green = 0.0F;
    float blue = 0.0F;
    float clear = 0.0F;
  };

  /// Adds the target's pixel at (x, y), with a weight that falls with its difference from `depth`.
  void addSample(int x, int y, float weight, float depth, Sample& sum) const {
    const SmokeBlock& from = block(x / kWidth, y);
    const int lane = x % kWidth;
    const float off = from.depth[lane] - depth;
    const float w = weight / (0.003F + off * off);
    sum.weight += w;
    sum.red += w * from.red[lane];
    sum.green += w * from.green[lane];
    sum.blue += w * from.blue[lane];
    sum.clear += w * from.clear[lane];
  }

  /// Blends `columns` of the frame's pixels in the target's pixel x of row y, `share` of the way to `otherY`.
  void blendJump(int x, int y, int otherY, float share, int columns, const float* depth, const std::uint32_t* kept,
                 std::uint32_t* colour) const {
    for (int i = 0; i < columns; ++i) {
      const float own = std::min(depth[i], farthest_);
      if (own <= nearest_) {
        colour[i] = kept[i];
        continue;
      }
      const float across = offset<Scale>(i);
      const int otherX = std::clamp(across < 0.0F ? x - 1 : x + 1, 0, pixels_.rect.width() - 1);
      const float aside = std::fabs(across);
      Sample sum;
      addSample(x, y, (1.0F - share) * (1.0F - aside), own, sum);
      addSample(otherX, y, (1.0F - share) * aside, own, sum);
      addSample(x, otherY, share * (1.0F - aside), own, sum);
      addSample(otherX, otherY, share * aside, own, sum);
      const float scale = 1.0F / sum.weight;
      const float bytes = 255.0F * scale;
      colour[i] = under(kept[i], bytes * sum.red, bytes * sum.green, bytes * sum.blue, scale * sum.clear);
    }
  }

  const SmokePixels& pixels_;
  const UpsampleRoom& room_;
  const float nearest_;
  const float farthest_;
  const std::ptrdiff_t wideStride_;
  std::array<int, kWideRows> wideRows_{};
};

template <int Scale>
HWY_INLINE void blendScaled(const SmokePixels& pixels, const UpsampleRoom& room, float nearest, float farthest,
                            raster::Image& frame) {
  Upsampling<Scale> upsampling(pixels, room, nearest, farthest);
  for (int y = 0; y < pixels.rect.height(); ++y) {
    int begin = pixels.blocksPerRow;
    int end = 0;
    for (int b = 0; b < pixels.blocksPerRow; ++b) {
      const SmokeSpan& span = pixels.spans[b];
      if (y < span.begin - 1 || y > span.end) continue;
      begin = std::min(begin, b);
      end = b + 1;
    }
    if (end <= begin) continue;
    const int first = std::max(begin * kWidth - 1, 0);
    const int last = std::min(end * kWidth + 1, pixels.rect.width());
    upsampling.blendRow(y, first, last, frame);
  }
}

void blendPixels(const SmokePixels& pixels, const UpsampleRoom& room, float nearest, float farthest,
                 raster::Image& frame) {
  if (pixels.scale == 2) return blendScaled<2>(pixels, room, nearest, farthest, frame);
  blendScaled<4>(pixels, room, nearest, farthest, frame);
}

}  // namespace grove::objects::fluid::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace grove::objects::fluid {

HWY_EXPORT(blendPixels);

void blendPixels(const SmokePixels& pixels, const UpsampleRoom& room, float nearest, float farthest,
                 raster::Image& frame) {
  HWY_DYNAMIC_DISPATCH(blendPixels)(pixels, room, nearest, farthest, frame);
}

}  // namespace grove::objects::fluid

#endif  // HWY_ONCE
