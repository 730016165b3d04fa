#include "raster/yuv_image.h"

#include <libyuv/convert_argb.h>
#include <libyuv/convert_from_argb.h>
#include <libyuv/planar_functions.h>

#include <cassert>

namespace grove::raster {
namespace {

[[maybe_unused]] bool isEven(const world::Rect& rect) {
  return rect.left % 2 == 0 && rect.top % 2 == 0 && rect.right % 2 == 0 && rect.bottom % 2 == 0;
}

[[maybe_unused]] bool holds(const world::Rect& rect, const world::Rect& part) { return overlap(rect, part) == part; }

/// Both kinds have 12 bits per pixel.
template <class Planes>
std::shared_ptr<Planes> acquirePlanes(ImagePool& pool, const world::Rect& rect) {
  assert(isEven(rect));
  struct Owned {
    Planes image;
    std::shared_ptr<void> memory;
  };
  const std::size_t size = static_cast<std::size_t>(rect.width()) * static_cast<std::size_t>(rect.height()) / 2 * 3;
  const auto owned = std::make_shared<Owned>();
  const ImagePool::Bytes bytes = pool.acquireBytes(size);
  owned->memory = bytes.owner;
  owned->image.rect = rect;
  owned->image.bytes = bytes.bytes;
  return {owned, &owned->image};
}

}  // namespace

std::shared_ptr<YuvImage> acquireYuv(ImagePool& pool, const world::Rect& rect) {
  return acquirePlanes<YuvImage>(pool, rect);
}

std::shared_ptr<SemiPlanarImage> acquireSemiPlanar(ImagePool& pool, const world::Rect& rect) {
  return acquirePlanes<SemiPlanarImage>(pool, rect);
}

// The library names colour orders by word, not by bytes: R, G, B, A in memory is its ABGR.

void toYuv(const Image& from, const world::Rect& part, YuvImage& to) {
  assert(isEven(part) && holds(from.rect, part) && holds(to.rect, part));
  const auto* const rgba =
      reinterpret_cast<const std::uint8_t*>(from.colourRow(part.top - from.rect.top) + (part.left - from.rect.left));
  const std::ptrdiff_t luma = to.lumaAt(part.left, part.top);
  const std::ptrdiff_t chroma = to.chromaAt(part.left, part.top);
  libyuv::ABGRToJ420(rgba, from.width() * 4, to.y() + luma, to.width(), to.u() + chroma, to.width() / 2,
                     to.v() + chroma, to.width() / 2, part.width(), part.height());
}

void toSemiPlanar(const Image& from, SemiPlanarImage& to) {
  assert(isEven(from.rect) && holds(to.rect, from.rect));
  const int width = from.width();
  const int lines = from.height() / 2;
  std::vector<std::uint8_t> chroma(static_cast<std::size_t>(width) * static_cast<std::size_t>(lines));
  std::uint8_t* const u = chroma.data();
  std::uint8_t* const v = u + chroma.size() / 2;
  libyuv::ABGRToJ420(reinterpret_cast<const std::uint8_t*>(from.colour.data()), width * 4,
                     to.y() + to.lumaAt(from.rect.left, from.rect.top), to.width(), u, width / 2, v, width / 2, width,
                     from.height());
  libyuv::MergeUVPlane(u, width / 2, v, width / 2, to.uv() + to.chromaAt(from.rect.left, from.rect.top), to.width(),
                       width / 2, lines);
}

void copyPart(const SemiPlanarImage& from, const world::Rect& part, SemiPlanarImage& to) {
  assert(isEven(part) && holds(from.rect, part) && holds(to.rect, part));
  libyuv::CopyPlane(from.y() + from.lumaAt(part.left, part.top), from.width(), to.y() + to.lumaAt(part.left, part.top),
                    to.width(), part.width(), part.height());
  libyuv::CopyPlane(from.uv() + from.chromaAt(part.left, part.top), from.width(),
                    to.uv() + to.chromaAt(part.left, part.top), to.width(), part.width(), part.height() / 2);
}

void copyPart(const SemiPlanarImage& from, const world::Rect& part, YuvImage& to) {
  assert(isEven(part) && holds(from.rect, part) && holds(to.rect, part));
  const std::ptrdiff_t chroma = to.chromaAt(part.left, part.top);
  libyuv::CopyPlane(from.y() + from.lumaAt(part.left, part.top), from.width(), to.y() + to.lumaAt(part.left, part.top),
                    to.width(), part.width(), part.height());
  libyuv::SplitUVPlane(from.uv() + from.chromaAt(part.left, part.top), from.width(), to.u() + chroma, to.width() / 2,
                       to.v() + chroma, to.width() / 2, part.width() / 2, part.height() / 2);
}

void copyPart(const YuvImage& from, const world::Rect& part, YuvImage& to) {
  assert(isEven(part) && holds(from.rect, part) && holds(to.rect, part));
  const std::ptrdiff_t chroma = from.chromaAt(part.left, part.top);
  const std::ptrdiff_t chromaTo = to.chromaAt(part.left, part.top);
  libyuv::CopyPlane(from.y() + from.lumaAt(part.left, part.top), from.width(), to.y() + to.lumaAt(part.left, part.top),
                    to.width(), part.width(), part.height());
  libyuv::CopyPlane(from.u() + chroma, from.width() / 2, to.u() + chromaTo, to.width() / 2, part.width() / 2,
                    part.height() / 2);
  libyuv::CopyPlane(from.v() + chroma, from.width() / 2, to.v() + chromaTo, to.width() / 2, part.width() / 2,
                    part.height() / 2);
}

void toRgba(const YuvImage& from, const world::Rect& part, Image& to) {
  assert(isEven(part) && holds(from.rect, part) && holds(to.rect, part));
  auto* const rgba = reinterpret_cast<std::uint8_t*>(to.colourRow(part.top - to.rect.top) + (part.left - to.rect.left));
  const std::ptrdiff_t luma = from.lumaAt(part.left, part.top);
  const std::ptrdiff_t chroma = from.chromaAt(part.left, part.top);
  libyuv::J420ToABGR(from.y() + luma, from.width(), from.u() + chroma, from.width() / 2, from.v() + chroma,
                     from.width() / 2, rgba, to.width() * 4, part.width(), part.height());
}

std::vector<std::uint32_t> rgbaOf(const YuvImage& image) {
  std::vector<std::uint32_t> pixels(static_cast<std::size_t>(image.width()) * static_cast<std::size_t>(image.height()));
  Image colours;
  colours.rect = image.rect;
  colours.colour = pixels;
  toRgba(image, image.rect, colours);
  return pixels;
}

}  // namespace grove::raster
