#include "node/frontend/compositing/composite_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "node/frontend/compositing/composite_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace grove::node::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

/// Each channel times the same channel of `shares` / 255, rounded.
template <class Tag, class V>
HWY_INLINE V scaled(Tag tag, V colour, V shares) {
  const hn::Repartition<std::uint16_t, Tag> halfTag;  // two channels of a pixel at a time
  const auto byte = hn::Set(halfTag, 0xFF);
  const auto channels = hn::BitCast(halfTag, colour);
  const auto factors = hn::BitCast(halfTag, hn::Or(shares, hn::ShiftLeft<16>(shares)));
  // (v + 128 + ((v + 128) >> 8)) >> 8 is v / 255 rounded.
  const auto product = [&](auto values) {
    const auto v = hn::Add(hn::Mul(values, factors), hn::Set(halfTag, 128));
    return hn::Add(v, hn::ShiftRight<8>(v));
  };
  const auto even = hn::ShiftRight<8>(product(hn::And(channels, byte)));
  const auto odd = hn::AndNot(byte, product(hn::ShiftRight<8>(channels)));
  return hn::BitCast(tag, hn::Or(even, odd));
}

/// One colour over the other.
template <class Tag, class V>
HWY_INLINE V mixed(Tag tag, V over, V under) {
  return hn::Add(over, scaled(tag, under, hn::Sub(hn::Set(tag, 0xFF), hn::ShiftRight<24>(over))));
}

/// As many pixels as `tag` has lanes.
template <class Tag>
HWY_INLINE void layPixels(Tag tag, LayerPixels layer, FramePixels frame, std::ptrdiff_t at, std::ptrdiff_t to) {
  const hn::Rebind<float, Tag> depthTag;
  const hn::RebindToSigned<Tag> signedTag;
  const auto over = hn::LoadU(tag, layer.colour + at);
  const auto overDepth = hn::LoadU(depthTag, layer.depth + at);
  const auto depth = hn::LoadU(depthTag, frame.depth + to);
  const auto coverage = hn::BitCast(signedTag, hn::ShiftRight<24>(over));
  const auto coversMoreThan = [&](int value) {
    return hn::RebindMask(depthTag, hn::Gt(coverage, hn::Set(signedTag, value)));
  };
  const auto shows = hn::And(hn::Le(overDepth, depth), coversMoreThan(0));
  if (hn::AllFalse(depthTag, shows)) return;
  const auto opaque = hn::And(shows, coversMoreThan(254));
  const auto partly = hn::RebindMask(tag, hn::AndNot(opaque, shows));
  const auto edgeDepth = hn::LoadU(depthTag, frame.edgeDepth + to);
  const auto behindEdge = hn::Gt(overDepth, edgeDepth);
  const auto none = hn::Set(depthTag, kNoEdge);
  // Loads and blends by hand: masked stores are ten times slower on some processors.
  const auto colour = hn::LoadU(tag, frame.colour + to);
  hn::StoreU(hn::IfThenElse(hn::RebindMask(tag, opaque), over, colour), tag, frame.colour + to);
  hn::StoreU(hn::IfThenElse(opaque, overDepth, depth), depthTag, frame.depth + to);
  hn::StoreU(hn::IfThenElse(hn::AndNot(behindEdge, shows), hn::IfThenElse(opaque, none, overDepth), edgeDepth),
             depthTag, frame.edgeDepth + to);
  if (hn::AllFalse(tag, partly)) return;
  const auto hasEdge = hn::RebindMask(tag, hn::Lt(edgeDepth, none));
  const auto before = hn::LoadU(tag, frame.edge + to);
  const auto edge = hn::IfThenElseZero(hasEdge, before);
  const auto isBehind = hn::RebindMask(tag, behindEdge);
  const auto joined = mixed(tag, hn::IfThenElse(isBehind, edge, over), hn::IfThenElse(isBehind, over, edge));
  hn::StoreU(hn::IfThenElse(partly, joined, before), tag, frame.edge + to);
}

/// Opaque pixels, in a frame without edges.
template <class Tag>
HWY_INLINE void layOpaquePixels(Tag tag, LayerPixels layer, FramePixels frame, std::ptrdiff_t at, std::ptrdiff_t to) {
  const hn::Rebind<float, Tag> depthTag;
  const auto overDepth = hn::LoadU(depthTag, layer.depth + at);
  const auto underDepth = hn::LoadU(depthTag, frame.depth + to);
  const auto shows = hn::Le(overDepth, underDepth);
  const auto over = hn::LoadU(tag, layer.colour + at);
  const auto under = hn::LoadU(tag, frame.colour + to);
  hn::StoreU(hn::IfThenElse(hn::RebindMask(tag, shows), over, under), tag, frame.colour + to);
  hn::StoreU(hn::IfThenElse(shows, overDepth, underDepth), depthTag, frame.depth + to);
}

template <class Tag>
HWY_INLINE void layEdgePixels(Tag tag, const FramePixels& frame, std::ptrdiff_t at) {
  const hn::Rebind<float, Tag> depthTag;
  const auto edgeDepth = hn::LoadU(depthTag, frame.edgeDepth + at);
  const auto hasEdge = hn::Lt(edgeDepth, hn::Set(depthTag, kNoEdge));
  if (hn::AllFalse(depthTag, hasEdge)) return;
  const auto edge = hn::LoadU(tag, frame.edge + at);
  const auto coverage = hn::BitCast(hn::RebindToSigned<Tag>(), edge);
  // The highest bit of a pixel is the highest bit of its coverage.
  const auto half = hn::MaskFromVec(hn::BitCast(depthTag, hn::BroadcastSignBit(coverage)));
  const auto depth = hn::LoadU(depthTag, frame.depth + at);
  hn::StoreU(hn::IfThenElse(hn::And(hasEdge, half), edgeDepth, depth), depthTag, frame.depth + at);
  const auto colour = hn::LoadU(tag, frame.colour + at);
  hn::StoreU(hn::IfThenElse(hn::RebindMask(tag, hasEdge), mixed(tag, edge, colour), colour), tag, frame.colour + at);
}

/// Calls lay(tag, first pixel) for all pixels of a row: vectors of `kCount` pixels, and smaller ones for what is left.
template <std::size_t kCount, class Lay>
HWY_INLINE void alongRow(std::ptrdiff_t from, std::ptrdiff_t width, const Lay& lay) {
  const hn::CappedTag<std::uint32_t, kCount> tag;
  const auto lanes = static_cast<std::ptrdiff_t>(hn::Lanes(tag));
  std::ptrdiff_t x = from;
  for (; x + lanes <= width; x += lanes) lay(tag, x);
  if constexpr (kCount > 1) {
    if (x < width) alongRow<hn::MaxLanes(tag) / 2>(x, width, lay);
  }
}

void composite(const LayerPixels& layer, const FramePixels& frame, int width, int height) {
  for (int row = 0; row < height; ++row) {
    alongRow<16>(0, width, [=](auto tag, std::ptrdiff_t x) {
      layPixels(tag, layer, frame, row * layer.stride + x, row * frame.stride + x);
    });
  }
}

void compositeOpaque(const LayerPixels& layer, const FramePixels& frame, int width, int height) {
  for (int row = 0; row < height; ++row) {
    alongRow<16>(0, width, [=](auto tag, std::ptrdiff_t x) {
      layOpaquePixels(tag, layer, frame, row * layer.stride + x, row * frame.stride + x);
    });
  }
}

bool allNearer(const float* depths, std::ptrdiff_t stride, int width, int height, float depth) {
  bool all = true;
  for (int row = 0; all && row < height; ++row) {
    alongRow<16>(0, width, [&](auto tag, std::ptrdiff_t x) {
      const hn::Rebind<float, decltype(tag)> depthTag;
      const auto here = hn::LoadU(depthTag, depths + row * stride + x);
      all = all && hn::AllTrue(depthTag, hn::Lt(here, hn::Set(depthTag, depth)));
    });
  }
  return all;
}

void layEdges(const FramePixels& frame, int width) {
  alongRow<16>(0, width, [&](auto tag, std::ptrdiff_t x) { layEdgePixels(tag, frame, x); });
}

}  // namespace
}  // namespace grove::node::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace grove::node {

HWY_EXPORT(composite);
HWY_EXPORT(compositeOpaque);
HWY_EXPORT(allNearer);
HWY_EXPORT(layEdges);

void composite(const LayerPixels& layer, const FramePixels& frame, int width, int height) {
  HWY_DYNAMIC_DISPATCH(composite)(layer, frame, width, height);
}

void compositeOpaque(const LayerPixels& layer, const FramePixels& frame, int width, int height) {
  HWY_DYNAMIC_DISPATCH(compositeOpaque)(layer, frame, width, height);
}

bool allNearer(const float* depths, std::ptrdiff_t stride, int width, int height, float depth) {
  return HWY_DYNAMIC_DISPATCH(allNearer)(depths, stride, width, height, depth);
}

void layEdges(const FramePixels& frame, int width) { HWY_DYNAMIC_DISPATCH(layEdges)(frame, width); }

}  // namespace grove::node

#endif  // HWY_ONCE
