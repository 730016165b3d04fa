#include "objects/lightfield/cache/reprojection_tile.h"

#include <algorithm>
#include <cmath>

#include "objects/lightfield/simd/lanes.h"

namespace grove::objects::lightfield {
namespace {

using simd::Floats;
using simd::Ints;
using simd::load;
using simd::store;

/// A tile's rays are looked at in steps of a texel (finer ones gain nothing); no cell of a sensible error needs more.
constexpr float kMostSteps = 64.0F;
/// Rays that move by less, in texels, do not leave theirs.
constexpr float kStill = 0.5F;
/// How many texels beside a ray's texel its point may lie, beyond half a step.
constexpr float kSlack = 0.4F;
constexpr float kNothing = -1.0e30F;
/// Steps to a share of 256.
constexpr float kShares = 256.0F;
constexpr float kRounding = 0.5F;
constexpr std::uint16_t kHalf = 128;
/// Of four channels the first and the third.
constexpr std::int32_t kEven = 0x00FF00FF;

/// A view's texels as the loops need them.
struct Texels {
  int stride;
  float softness;
  float limitX;
  float limitY;
  world::Vec3 m;

  Texels(const CachedView& view, const ViewWarp& warp)
      : stride(view.width()),
        softness(view.softness()),
        // The last column and row are for bilinear look-ups only.
        limitX(static_cast<float>(view.width()) - 1.001F),
        limitY(static_cast<float>(view.height()) - 1.001F),
        m(warp.m) {}
};

void beginRow(world::Vec3 k, world::Vec3 step, float* __restrict a0, float* __restrict a1,
              float* __restrict perForward) {
  for (int i = 0; i < kTileWidth; ++i) {
    const auto x = static_cast<float>(i);
    const float scale = 1.0F / std::max(k.z + x * step.z, kLeastForward);
    a0[i] = (k.x + x * step.x) * scale;
    a1[i] = (k.y + x * step.y) * scale;
    perForward[i] = scale;
  }
}

}  // namespace

ViewWarp::ViewWarp(const CachedView& view, const ObjectCamera& camera) {
  const ObjectCamera& own = view.camera();
  const world::Vec3 corner =
      own.corner + static_cast<float>(view.left()) * own.perColumn + static_cast<float>(view.top()) * own.perRow;
  const glm::dmat3 inverse = glm::inverse(glm::dmat3(own.perColumn, own.perRow, corner));
  k = inverse * glm::dvec3(camera.corner);
  kPerColumn = inverse * glm::dvec3(camera.perColumn);
  kPerRow = inverse * glm::dvec3(camera.perRow);
  m = inverse * (glm::dvec3(camera.eye) - glm::dvec3(own.eye));
}

void beginTile(const ViewWarp& warp, int left, int top, WarpTile& tile) {
  for (int row = 0; row < kTileHeight; ++row) {
    const world::Vec3 k = warp.k + (static_cast<float>(left) + 0.5F) * warp.kPerColumn +
                          (static_cast<float>(top + row) + 0.5F) * warp.kPerRow;
    const int at = row * kTileWidth;
    beginRow(k, warp.kPerColumn, tile.a0 + at, tile.a1 + at, tile.perForward + at);
  }
}

namespace {

/// What each ray has met so far, texels as CachedView::nearness().
struct Met {
  alignas(64) float best[kTilePixels];       ///< the best texel that lies on it, or kNothing
  alignas(64) float bestPlace[kTilePixels];  ///< the w where that was
  alignas(64) float far[kTilePixels];        ///< 1 / depth of the farthest texel passed
  alignas(64) float farPlace[kTilePixels];
};

/// Looks at the texel of each ray at nearness `w`.
void look(const Texels& view, const float* __restrict nearness, float w, float permitted, const float* __restrict a0,
          const float* __restrict a1, float* __restrict best, float* __restrict bestPlace, float* __restrict far,
          float* __restrict farPlace) {
  const int stride = view.stride;
  const float softness = view.softness;
  const float limitX = view.limitX;
  const float limitY = view.limitY;
  const float scale = 1.0F - view.m.z * w;
  const float offsetX = view.m.x * w;
  const float offsetY = view.m.y * w;
  for (int i = 0; i < kTilePixels; ++i) {
    const float x = std::min(std::max(a0[i] * scale + offsetX, 0.0F), limitX);
    const float y = std::min(std::max(a1[i] * scale + offsetY, 0.0F), limitY);
    const float ranked = nearness[static_cast<int>(y) * stride + static_cast<int>(x)];
    const float near = ranked < 0.0F ? ranked + softness : ranked;
    const float lying = std::fabs(near - w) <= permitted ? ranked : kNothing;
    bestPlace[i] = lying > best[i] ? w : bestPlace[i];
    best[i] = std::max(best[i], lying);
    farPlace[i] = near < far[i] ? w : farPlace[i];
    far[i] = std::min(far[i], near);
  }
}

/// Whether every ray has met a texel that hides what is behind it.
bool allHidden(const float* __restrict best) {
  float least = 0.0F;
  for (int i = 0; i < kTilePixels; ++i) least = std::min(least, best[i]);
  return least >= 0.0F;
}

/// What rays that stay in their texels show.
void glance(const Texels& view, const float* __restrict nearness, float w, const float* __restrict a0,
            const float* __restrict a1, float* __restrict place, float* __restrict shown) {
  const int stride = view.stride;
  const float softness = view.softness;
  const float limitX = view.limitX;
  const float limitY = view.limitY;
  const float scale = 1.0F - view.m.z * w;
  const float offsetX = view.m.x * w;
  const float offsetY = view.m.y * w;
  for (int i = 0; i < kTilePixels; ++i) {
    const float x = std::min(std::max(a0[i] * scale + offsetX, 0.0F), limitX);
    const float y = std::min(std::max(a1[i] * scale + offsetY, 0.0F), limitY);
    const float ranked = nearness[static_cast<int>(y) * stride + static_cast<int>(x)];
    const float near = ranked < 0.0F ? ranked + softness : ranked;
    place[i] = near > 0.0F ? near : w;
    shown[i] = near;
  }
}

/// Decides what each ray shows. The best texel lies on the ray to half a step; the one at the place that belongs to its
/// depth is better if it is of the same surface. If that is farther away, the surface ends between both, and the colour
/// there is that of its edge. If it is nearer, it hides what the ray meets, of which the texel found is all that is
/// known.
void settle(const Texels& view, const float* __restrict nearness, float permitted, const float* __restrict a0,
            const float* __restrict a1, const float* __restrict best, const float* __restrict bestPlace,
            const float* __restrict far, const float* __restrict farPlace, float* __restrict place,
            float* __restrict shown) {
  const int stride = view.stride;
  const float softness = view.softness;
  const float limitX = view.limitX;
  const float limitY = view.limitY;
  const world::Vec3 m = view.m;
  for (int i = 0; i < kTilePixels; ++i) {
    const bool lies = best[i] > 0.5F * kNothing;
    const float found = best[i] < 0.0F ? best[i] + softness : best[i];
    const float w = lies ? found : farPlace[i];
    const float scale = 1.0F - m.z * w;
    const float x = std::min(std::max(a0[i] * scale + m.x * w, 0.0F), limitX);
    const float y = std::min(std::max(a1[i] * scale + m.y * w, 0.0F), limitY);
    const float ranked = nearness[static_cast<int>(y) * stride + static_cast<int>(x)];
    const float near = ranked < 0.0F ? ranked + softness : ranked;
    const bool same = std::fabs(near - w) <= permitted;
    const bool hidden = near > w + permitted;
    const float exact = same ? near : (hidden ? bestPlace[i] : w);
    place[i] = lies ? exact : farPlace[i];
    shown[i] = lies ? (same ? near : found) : far[i];
  }
}

/// Two channels of 8 bits, each in 16.
using Channels [[gnu::vector_size(simd::kLanes * 4)]] = std::uint16_t;

inline Channels channels(Ints value) { return reinterpret_cast<Channels>(value); }
inline Ints share(Floats part) { return simd::truncated(part * kShares + kRounding); }
inline Channels twice(Ints value) { return channels(value | value << 16); }
inline Channels eachOf(std::uint32_t value) { return channels(static_cast<std::int32_t>(value) - Ints{}); }

/// The air as shadePixels() mixes it in.
struct Air {
  Channels clear;
  Channels even;
  Channels odd;

  explicit Air(const Haze& haze) {
    const float amount = std::clamp(haze.amount, 0.0F, 1.0F);
    const auto part = [](float value) { return static_cast<std::uint32_t>(value * kShares + kRounding); };
    const auto hazy = [&](std::size_t channel) { return part(amount * std::clamp(haze.colour[channel], 0.0F, 1.0F)); };
    clear = eachOf((256U - part(amount)) * 0x00010001U);
    even = eachOf(hazy(2) << 16U | hazy(0));
    odd = eachOf(part(amount) << 16U | hazy(1));
  }
};

/// As many neighbouring pixels as there are lanes; -1 where one shows anything.
inline Ints shadePixels(const Texels& view, const Air& air, const std::uint32_t* texels, WarpTile& tile, int first) {
  const Floats w = load(tile.place + first);
  const Floats scale = 1.0F - view.m.z * w;
  const Floats none{};
  const Floats x = simd::clamped(load(tile.a0 + first) * scale + view.m.x * w - 0.5F, none, simd::all(view.limitX));
  const Floats y = simd::clamped(load(tile.a1 + first) * scale + view.m.y * w - 0.5F, none, simd::all(view.limitY));
  const Ints column = simd::truncated(x);
  const Ints row = simd::truncated(y);
  // Weights of the four texels that add up to 256, so that a channel's sum fits into 16 bits.
  const Ints right = share(x - simd::toFloats(column));
  const Ints down = share(y - simd::toFloats(row));
  const Ints both = (right * down + 128) >> 8;
  const Channels w11 = twice(both);
  const Channels w10 = twice(right - both);
  const Channels w01 = twice(down - both);
  const Channels w00 = twice(256 - right - down + both);
  const Ints at = row * view.stride + column;
  const simd::Pair above = simd::lookUpPair(texels, at);
  const simd::Pair below = simd::lookUpPair(texels, at + view.stride);
  const auto mixed = [&](int shift) {
    const auto of = [&](Ints texel) { return channels(texel >> shift & kEven); };
    return of(above.first) * w00 + of(above.second) * w10 + of(below.first) * w01 + of(below.second) * w11;
  };
  Channels even = (mixed(0) + kHalf) >> 8;
  Channels odd = (mixed(8) + kHalf) >> 8;
  const Ints cover = reinterpret_cast<Ints>(odd) >> 16;
  const Channels hazed = twice(cover);
  even = (even * air.clear + hazed * air.even + kHalf) >> 8;
  odd = (odd * air.clear + hazed * air.odd + kHalf) >> 8;
  const Floats near = load(tile.near + first);
  const Ints there = (near > 0.0F) & (cover != 0);
  const Floats away = (1.0F / simd::most(near, simd::all(1.0e-20F)) - view.m.z) * load(tile.perForward + first);
  store(there & (reinterpret_cast<Ints>(odd) << 8 | reinterpret_cast<Ints>(even)), tile.colour + first);
  store(there ? away : simd::all(world::kInfiniteDepth), tile.depth + first);
  return there;
}

}  // namespace

void searchTile(const CachedView& view, const ViewWarp& warp, const CachedView::Range& reach, float texelsPerNearness,
                WarpTile& tile) {
  const Texels texels(view, warp);
  const float range = reach.greatest - reach.least;
  const float way = range * texelsPerNearness;
  if (way < kStill) {
    glance(texels, view.nearness(), reach.least + 0.5F * range, tile.a0, tile.a1, tile.place, tile.near);
    return;
  }
  Met met;
  std::fill_n(met.best, kTilePixels, kNothing);
  std::fill_n(met.far, kTilePixels, -kNothing);
  const int steps = static_cast<int>(std::clamp(std::ceil(way), 1.0F, kMostSteps));
  const float step = range / static_cast<float>(steps);
  const float permitted = 0.5F * step + kSlack / texelsPerNearness;
  for (int j = 0; j < steps; ++j) {
    const float w = reach.greatest - (static_cast<float>(j) + 0.5F) * step;
    look(texels, view.nearness(), w, permitted, tile.a0, tile.a1, met.best, met.bestPlace, met.far, met.farPlace);
    if (allHidden(met.best)) break;
  }
  settle(texels, view.nearness(), permitted, tile.a0, tile.a1, met.best, met.bestPlace, met.far, met.farPlace,
         tile.place, tile.near);
}

bool shadeTile(const CachedView& view, const ViewWarp& warp, const Haze& haze, WarpTile& tile) {
  const Texels texels(view, warp);
  const Air air(haze);
  Ints shows{};
  for (int i = 0; i < kTilePixels; i += simd::kLanes) shows |= shadePixels(texels, air, view.colour(), tile, i);
  return simd::any(shows);
}

}  // namespace grove::objects::lightfield
