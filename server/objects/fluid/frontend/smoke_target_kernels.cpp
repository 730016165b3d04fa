#include "objects/fluid/frontend/smoke_target_kernels.h"

#include <algorithm>
#include <cmath>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "objects/fluid/frontend/smoke_target_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "base/simd/lanes_inl.h"

HWY_BEFORE_NAMESPACE();
namespace grove::objects::fluid::HWY_NAMESPACE {

using namespace simd::HWY_NAMESPACE;

constexpr int kWidth = SmokeBlock::kWidth;
static_assert(kWidth % kLanes == 0);

/// Almost nothing of the background is visible; smaller numbers become denormal, which costs a hundred times as much.
constexpr float kOpaque = 1e-12F;

/// Nearest and farthest depth over `rows` rows of the frame, starting at `depth`.
HWY_INLINE void reduceRows(const float* depth, int stride, int rows, int width, float farthest, float* __restrict low,
                           float* __restrict high) {
  for (int x = 0; x < width; ++x) low[x] = high[x] = std::min(depth[x], farthest);
  for (int r = 1; r < rows; ++r) {
    const float* __restrict next = depth + std::ptrdiff_t{r} * stride;
    for (int x = 0; x < width; ++x) {
      const float value = std::min(next[x], farthest);
      low[x] = std::min(low[x], value);
      high[x] = std::max(high[x], value);
    }
  }
}

template <int Scale>
HWY_INLINE Floats minOfEach(const float* row) {
  hn::Vec<FloatTag> a, b, c, d;
  if constexpr (Scale == 2) {
    hn::LoadInterleaved2(FloatTag(), row, a, b);
    return hn::Min(a, b);
  } else {
    hn::LoadInterleaved4(FloatTag(), row, a, b, c, d);
    return hn::Min(hn::Min(a, b), hn::Min(c, d));
  }
}

template <int Scale>
HWY_INLINE Floats maxOfEach(const float* row) {
  hn::Vec<FloatTag> a, b, c, d;
  if constexpr (Scale == 2) {
    hn::LoadInterleaved2(FloatTag(), row, a, b);
    return hn::Max(a, b);
  } else {
    hn::LoadInterleaved4(FloatTag(), row, a, b, c, d);
    return hn::Max(hn::Max(a, b), hn::Max(c, d));
  }
}

/// Row `y` of the target's depths; pixels with odd x + y take the nearest.
template <int Scale>
HWY_INLINE void reduceColumns(const float* low, const float* high, int y, const SmokePixels& pixels) {
  const Mask takesNearest = ((upwards() + Ints(pixels.rect.top + y + pixels.rect.left)) & Ints(1)) == Ints(1);
  for (int x = 0; x < pixels.blocksPerRow * kWidth; x += kLanes) {
    const Floats depth = select(takesNearest, minOfEach<Scale>(low + x * Scale), maxOfEach<Scale>(high + x * Scale));
    store(depth, pixels.column(x / kWidth)[y].depth + x % kWidth);
  }
}

void clearPixels(const raster::Image& frame, float farthest, float* low, float* high, const SmokePixels& pixels) {
  const world::Rect& rect = pixels.rect;
  const int scale = pixels.scale;
  const int left = rect.left * scale;
  const int width = std::min(rect.right * scale, frame.width()) - left;
  const int padded = pixels.blocksPerRow * kWidth * scale;
  for (int y = 0; y < rect.height(); ++y) {
    const int top = (rect.top + y) * scale;
    const int rows = std::min(scale, frame.height() - top);
    reduceRows(frame.depthRow(top) + left, frame.width(), rows, width, farthest, low, high);
    std::fill(low + width, low + padded, low[width - 1]);
    std::fill(high + width, high + padded, high[width - 1]);
    for (int b = 0; b < pixels.blocksPerRow; ++b) {
      SmokeBlock& block = pixels.column(b)[y];
      for (float* channel : {block.red, block.green, block.blue, block.age, block.distance})
        std::fill_n(channel, kWidth, 0.0F);
      std::fill_n(block.clear, kWidth, 1.0F);
    }
    if (scale == 2) {
      reduceColumns<2>(low, high, y, pixels);
    } else {
      reduceColumns<4>(low, high, y, pixels);
    }
  }
}

/// A sprite in pixels of the target.
struct Ellipse {
  float x, y;
  float xx, xy, yy;
  float depth, sharpness;
  float red, green, blue, opacity;
  float age;
};

/// Draws rows top..bottom of kLanes columns of pixels, which begin at `lane` of these blocks and at column `from` of
/// the target. Goes down the columns, not along the rows: a sprite is one to four blocks wide, and such short loops
/// cost more in branch mispredictions than in work.
HWY_INLINE void drawColumns(const Ellipse& e, float from, int lane, int top, int bottom, SmokeBlock* column) {
  const Floats dx = toFloats(upwards()) + Floats(from - e.x);
  const Floats constant = Floats(1.0F) - Floats(e.xx) * dx * dx;
  const Floats slope = Floats(2.0F * e.xy) * dx;
  const Floats zero(0.0F);
  const Floats one(1.0F);
  const Floats opaque(kOpaque);
  const Floats own(e.depth);
  const Floats sharpness(e.sharpness);
  const Floats opacity(e.opacity);
  const Floats red(e.red);
  const Floats green(e.green);
  const Floats blue(e.blue);
  const Floats age(e.age);
  for (int y = top; y < bottom; ++y) {
    SmokeBlock& block = column[y];
    const float dy = static_cast<float>(y) - e.y;
    const Floats bell = max(zero, constant - (slope + Floats(e.yy * dy)) * Floats(dy));
    const Floats free = min(one, max(zero, (load(block.depth + lane) - own) * sharpness));
    const Floats weight = bell * bell * free;
    const Floats cover = weight * opacity;
    const Floats keep = one - cover;
    store(mulAdd(weight, red, load(block.red + lane) * keep), block.red + lane);
    store(mulAdd(weight, green, load(block.green + lane) * keep), block.green + lane);
    store(mulAdd(weight, blue, load(block.blue + lane) * keep), block.blue + lane);
    store(mulAdd(cover, age, load(block.age + lane) * keep), block.age + lane);
    store(mulAdd(cover, own, load(block.distance + lane) * keep), block.distance + lane);
    store(max(opaque, load(block.clear + lane) * keep), block.clear + lane);
  }
}

HWY_INLINE void drawSprite(const SmokeSprites& sprites, std::uint32_t sprite, const SmokePixels& pixels) {
  const float perPixel = 1.0F / static_cast<float>(pixels.scale);
  const auto square = static_cast<float>(pixels.scale * pixels.scale);
  const Ellipse e{.x = sprites.x[sprite] * perPixel - 0.5F - static_cast<float>(pixels.rect.left),
                  .y = sprites.y[sprite] * perPixel - 0.5F - static_cast<float>(pixels.rect.top),
                  .xx = sprites.xx[sprite] * square,
                  .xy = sprites.xy[sprite] * square,
                  .yy = sprites.yy[sprite] * square,
                  .depth = sprites.depth[sprite],
                  .sharpness = 1.0F / sprites.softness[sprite],
                  .red = sprites.red[sprite],
                  .green = sprites.green[sprite],
                  .blue = sprites.blue[sprite],
                  .opacity = sprites.opacity[sprite],
                  .age = sprites.age[sprite]};
  const float halfWidth = sprites.halfWidth[sprite] * perPixel;
  const auto widest = static_cast<float>(pixels.rect.width() - 1);
  const auto height = static_cast<float>(pixels.rect.height());
  const float left = std::max(e.x - halfWidth, 0.0F);
  const float right = std::min(e.x + halfWidth, widest);
  if (left > right) return;

  // At dx from the centre the ellipse extends from -slant dx - reach to -slant dx + reach, reach^2 = span - narrowing
  // dx^2. Both ends have their extremes at -+extreme.
  const float span = 1.0F / e.yy;
  const float slant = e.xy * span;
  const float narrowing = (e.xx - e.xy * slant) * span;
  const float extreme = slant * std::sqrt(span / (narrowing * (narrowing + slant * slant)));
  const auto reach = [&](float dx) { return std::sqrt(std::max(0.0F, span - narrowing * dx * dx)); };

  // Narrower registers follow the ellipse more closely, which makes up for part of their width.
  for (int x = static_cast<int>(left) / kLanes * kLanes; x <= static_cast<int>(right); x += kLanes) {
    const auto from = static_cast<float>(x);
    const float low = from - e.x;
    const float high = low + static_cast<float>(kLanes - 1);
    const float atBottom = std::min(std::max(-extreme, low), high);
    const float atTop = std::min(std::max(extreme, low), high);
    const float highest = e.y - slant * atTop - reach(atTop);
    const float lowest = e.y - slant * atBottom + reach(atBottom);
    const int top = static_cast<int>(std::ceil(std::max(highest, 0.0F)));
    const int bottom = static_cast<int>(std::min(lowest + 1.0F, height));
    if (top >= bottom) continue;
    SmokeSpan& touched = pixels.spans[x / kWidth];
    touched = {std::min(touched.begin, top), std::max(touched.end, bottom)};
    drawColumns(e, from, x % kWidth, top, bottom, pixels.column(x / kWidth));
  }
}

void drawSprites(const SmokeSprites& sprites, std::span<const std::uint32_t> order, const SmokePixels& pixels) {
  for (const std::uint32_t sprite : order) drawSprite(sprites, sprite, pixels);
}

}  // namespace grove::objects::fluid::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace grove::objects::fluid {

HWY_EXPORT(clearPixels);
HWY_EXPORT(drawSprites);

void clearPixels(const raster::Image& frame, float farthest, float* low, float* high, const SmokePixels& pixels) {
  HWY_DYNAMIC_DISPATCH(clearPixels)(frame, farthest, low, high, pixels);
}

void drawSprites(const SmokeSprites& sprites, std::span<const std::uint32_t> order, const SmokePixels& pixels) {
  HWY_DYNAMIC_DISPATCH(drawSprites)(sprites, order, pixels);
}

}  // namespace grove::objects::fluid

#endif  // HWY_ONCE
