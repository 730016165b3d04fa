#include "node/frontend/composite_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "node/frontend/composite_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace grove::node::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

/// As many pixels as `tag` has lanes.
template <class Tag>
HWY_INLINE void layPixels(Tag tag, const std::uint32_t* HWY_RESTRICT layerColour, const float* HWY_RESTRICT layerDepth,
                          std::uint32_t* HWY_RESTRICT colour, float* HWY_RESTRICT depth) {
  const hn::Rebind<float, Tag> depthTag;
  const hn::Repartition<std::uint16_t, Tag> halfTag;  // two channels of a pixel at a time
  const auto over = hn::LoadU(tag, layerColour);
  const auto under = hn::LoadU(tag, colour);
  const auto overDepth = hn::LoadU(depthTag, layerDepth);
  const auto underDepth = hn::LoadU(depthTag, depth);

  const auto byte = hn::Set(halfTag, 0xFF);
  const auto alpha = hn::ShiftRight<24>(over);
  const auto rest = hn::Sub(byte, hn::BitCast(halfTag, hn::Or(alpha, hn::ShiftLeft<16>(alpha))));
  const auto halves = hn::BitCast(halfTag, under);
  // (v + 128 + ((v + 128) >> 8)) >> 8 is v / 255 rounded.
  const auto scaled = [&](auto channels) {
    const auto product = hn::Add(hn::Mul(channels, rest), hn::Set(halfTag, 128));
    return hn::Add(product, hn::ShiftRight<8>(product));
  };
  const auto even = hn::ShiftRight<8>(scaled(hn::And(halves, byte)));
  const auto odd = hn::AndNot(byte, scaled(hn::ShiftRight<8>(halves)));
  const auto blended = hn::Add(over, hn::BitCast(tag, hn::Or(even, odd)));

  const auto nearer = hn::Le(overDepth, underDepth);
  // The highest bit of a pixel is that of its coverage.
  const auto coverage = hn::BroadcastSignBit(hn::BitCast(hn::RebindToSigned<Tag>(), over));
  const auto covers = hn::MaskFromVec(hn::BitCast(depthTag, coverage));
  hn::StoreU(hn::IfThenElse(hn::RebindMask(tag, nearer), blended, under), tag, colour);
  hn::StoreU(hn::IfThenElse(hn::And(nearer, covers), overDepth, underDepth), depthTag, depth);
}

/// By vectors of `kCount` pixels, and what is left by smaller ones.
template <std::size_t kCount>
HWY_INLINE void layRow(const std::uint32_t* layerColour, const float* layerDepth, std::uint32_t* colour, float* depth,
                       std::size_t width) {
  const hn::CappedTag<std::uint32_t, kCount> tag;
  std::size_t x = 0;
  for (; x + hn::Lanes(tag) <= width; x += hn::Lanes(tag)) {
    layPixels(tag, layerColour + x, layerDepth + x, colour + x, depth + x);
  }
  if constexpr (kCount > 1) {
    if (x < width) layRow<hn::MaxLanes(tag) / 2>(layerColour + x, layerDepth + x, colour + x, depth + x, width - x);
  }
}

void composite(const LayerPixels& layer, const FramePixels& frame, int width, int height) {
  for (int row = 0; row < height; ++row) {
    layRow<16>(layer.colour + row * layer.stride, layer.depth + row * layer.stride, frame.colour + row * frame.stride,
               frame.depth + row * frame.stride, static_cast<std::size_t>(width));
  }
}

}  // namespace
}  // namespace grove::node::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace grove::node {

HWY_EXPORT(composite);

void composite(const LayerPixels& layer, const FramePixels& frame, int width, int height) {
  HWY_DYNAMIC_DISPATCH(composite)(layer, frame, width, height);
}

}  // namespace grove::node

#endif  // HWY_ONCE
