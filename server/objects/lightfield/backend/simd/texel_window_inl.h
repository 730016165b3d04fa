// Copies the parts of views that a tile reads. For kernels: included once per target.

#if defined(GROVE_OBJECTS_LIGHTFIELD_BACKEND_SIMD_TEXEL_WINDOW_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef GROVE_OBJECTS_LIGHTFIELD_BACKEND_SIMD_TEXEL_WINDOW_INL_H
#undef GROVE_OBJECTS_LIGHTFIELD_BACKEND_SIMD_TEXEL_WINDOW_INL_H
#else
#define GROVE_OBJECTS_LIGHTFIELD_BACKEND_SIMD_TEXEL_WINDOW_INL_H
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "objects/lightfield/backend/simd/lens.h"
#include "objects/lightfield/backend/simd/texel_window.h"
#include "world/camera.h"

HWY_BEFORE_NAMESPACE();
namespace grove::objects::lightfield::simd::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

constexpr std::size_t kNoTexel = ~std::size_t{0};

/// Calls copyRows(first texel in the field or kNoTexel, first texel in the window, rows) for every block in the box.
template <typename CopyRows>
HWY_INLINE void forEachBlock(const LightField& field, int level, int view, const TexelBox& box,
                             const WindowLayout& layout, CopyRows copyRows) {
  const int across = field.blocksAcross(level);
  const std::uint32_t* blocks =
      field.blocks[static_cast<std::size_t>(level)].data() + std::ptrdiff_t{view} * across * across;
  for (int line = box.top / kBlock; line <= box.bottom / kBlock; ++line) {
    const int top = box.top > line * kBlock ? box.top : line * kBlock;
    const int bottom = box.bottom + 1 < (line + 1) * kBlock ? box.bottom + 1 : (line + 1) * kBlock;
    const auto within = static_cast<std::size_t>((top - line * kBlock) * kBlockStride);
    for (int column = box.left / kBlock; column <= box.right / kBlock; ++column) {
      const std::uint32_t block = blocks[line * across + column];
      const std::size_t from = block == kNoBlock ? kNoTexel : std::size_t{block} * kBlockTexels + within;
      copyRows(from, std::ptrdiff_t{top} * layout.stride + column * kBlock - layout.origin, bottom - top);
    }
  }
}

template <typename Texel>
HWY_INLINE void copyBlock(const Texel* __restrict from, Texel* __restrict to, int stride, int rows) {
  for (int row = 0; row < rows; ++row) {
    std::memcpy(to + std::ptrdiff_t{row} * stride, from + std::ptrdiff_t{row} * kBlockStride, kBlock * sizeof(Texel));
  }
}

template <typename Texel>
HWY_INLINE void fillBlock(Texel value, Texel* __restrict to, int stride, int rows) {
  for (int row = 0; row < rows; ++row) {
    for (int i = 0; i < kBlock; ++i) to[std::ptrdiff_t{row} * stride + i] = value;
  }
}

inline void loadWindow(const LightField& field, int level, int view, int lighting, const TexelBox& box,
                       TexelWindow& window) {
  window.layout = WindowLayout(box);
  if (window.depth.size() < window.layout.texels) {
    window.depth.resize(window.layout.texels);
    window.colour.resize(window.layout.texels);
  }
  const int stride = window.layout.stride;
  const std::uint16_t* const depths = field.depth.data();
  const std::uint32_t* const colours = field.colour[static_cast<std::size_t>(lighting)].data();
  std::uint16_t* const toDepth = window.depth.data();
  std::uint32_t* const toColour = window.colour.data();
  forEachBlock(field, level, view, box, window.layout, [&](std::size_t from, std::ptrdiff_t to, int rows) {
    if (from == kNoTexel) {
      fillBlock(kNoDepth, toDepth + to, stride, rows);
      fillBlock(0U, toColour + to, stride, rows);
    } else {
      copyBlock(depths + from, toDepth + to, stride, rows);
      copyBlock(colours + from, toColour + to, stride, rows);
    }
  });
}

/// Returns false if no texel in the box is covered.
inline bool loadWindow(const LightField& field, int level, const Lens& lens, const TexelBox& box,
                       NearnessWindow& window) {
  const hn::CappedTag<float, kBlock> floats;
  const hn::Rebind<std::uint16_t, decltype(floats)> depths;
  const hn::RebindToSigned<decltype(floats)> ints;
  const std::size_t lanes = hn::Lanes(floats);
  window.layout = WindowLayout(box);
  if (window.nearness.size() < window.layout.texels) window.nearness.resize(window.layout.texels);
  const int stride = window.layout.stride;
  float* const nearness = window.nearness.data();
  const auto depthStep = hn::Set(floats, lens.depthStep);
  const auto nearDepth = hn::Set(floats, lens.nearDepth);
  const auto one = hn::Set(floats, 1.0F);
  const auto nothing = hn::Set(ints, kNoDepth);
  const auto nowhere = hn::Set(floats, kNowhere);
  const auto infinite = hn::Set(floats, world::kInfiniteDepth);
  auto high = hn::Zero(floats);
  auto low = infinite;
  forEachBlock(field, level, lens.view, box, window.layout, [&](std::size_t from, std::ptrdiff_t to, int rows) {
    float* __restrict out = nearness + to;
    if (from == kNoTexel) return fillBlock(kNowhere, out, stride, rows);
    const std::uint16_t* __restrict in = field.depth.data() + from;
    for (int row = 0; row < rows; ++row) {
      for (std::size_t i = 0; i < kBlock; i += lanes) {
        const auto stored = hn::PromoteTo(ints, hn::LoadU(depths, in + i));
        const auto covered = hn::RebindMask(floats, hn::Ne(stored, nothing));
        const auto near = hn::Div(one, hn::MulAdd(hn::ConvertTo(floats, stored), depthStep, nearDepth));
        hn::StoreU(hn::IfThenElse(covered, near, nowhere), floats, out + i);
        high = hn::Max(high, hn::IfThenElseZero(covered, near));
        low = hn::Min(low, hn::IfThenElse(covered, near, infinite));
      }
      in += kBlockStride;
      out += stride;
    }
  });
  const float largest = hn::GetLane(hn::MaxOfLanes(floats, high));
  if (largest <= 0.0F) return false;
  window.nearest = 1.0F / largest;
  window.farthest = 1.0F / hn::GetLane(hn::MinOfLanes(floats, low));
  return true;
}

}  // namespace grove::objects::lightfield::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // once per target
