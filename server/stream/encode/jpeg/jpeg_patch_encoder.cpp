#include "stream/encode/jpeg/jpeg_patch_encoder.h"

#include <algorithm>
#include <functional>
#include <numeric>

#include "stream/encode/jpeg/changed_blocks.h"
#include "stream/protocol/jpeg_patches.h"
#include "stream/protocol/protocol.h"
#include "stream/protocol/saturate.h"

namespace grove::stream {
namespace {

/// Blocks that take about as many bytes as the header of one more JPEG.
constexpr int kHeaderBlocks = 32;
/// Share of the picture above which it is encoded whole, so that it depends on no other.
constexpr double kMostChanges = 0.7;
/// A whole picture replaces parts that are coarser by this.
constexpr Quantiser kCoarser = 3.0;

double areaOf(const world::Rect& rect) { return static_cast<double>(rect.width()) * rect.height(); }

}  // namespace

std::uint8_t JpegPatchEncoder::codec() const noexcept { return kCodecJpegPatches; }

bool JpegPatchEncoder::encode(const raster::YuvImage& picture, const EncodeOrder& order,
                              std::vector<std::uint8_t>& out) {
  const bool mayDepend =
      order.still && !order.independent && kept_.rect == picture.rect && order.quantiser > quantiser_ - kCoarser;
  if (mayDepend && encodeChanges(picture, order.quantiser, out)) return false;
  append(picture, picture.rect, order.quantiser, out);
  quantiser_ = order.quantiser;
  // A moving camera changes every part, so the next picture will hardly need this one.
  if (order.still) {
    keep(picture);
  } else {
    kept_.rect = {};
  }
  return true;
}

bool JpegPatchEncoder::encodeChanges(const raster::YuvImage& picture, Quantiser quantiser,
                                     std::vector<std::uint8_t>& out) {
  const std::vector<world::Rect> parts = ChangedBlocks(kept_, picture).rectangles(kHeaderBlocks);
  const double area = std::transform_reduce(parts.begin(), parts.end(), 0.0, std::plus(), areaOf);
  // Where nothing has changed, a finer picture is wanted.
  if (parts.empty() || area > kMostChanges * areaOf(picture.rect)) return false;
  for (const world::Rect& part : parts) {
    append(picture, part, quantiser, out);
    raster::copyPart(picture, part, kept_);
  }
  quantiser_ = std::max(quantiser_, quantiser);
  return true;
}

void JpegPatchEncoder::append(const raster::YuvImage& picture, const world::Rect& part, Quantiser quantiser,
                              std::vector<std::uint8_t>& out) {
  const std::size_t header = out.size();
  out.resize(header + kPatchHeaderBytes);
  compressor_.compress(picture, part, quantiser, out);
  encodePatchHeader(saturate<std::uint16_t>(part.left - picture.rect.left),
                    saturate<std::uint16_t>(part.top - picture.rect.top),
                    static_cast<std::uint32_t>(out.size() - header - kPatchHeaderBytes),
                    std::span(out).subspan(header).first<kPatchHeaderBytes>());
}

void JpegPatchEncoder::keep(const raster::YuvImage& picture) {
  memory_.assign(picture.bytes.begin(), picture.bytes.end());
  kept_.rect = picture.rect;
  kept_.bytes = raster::Plane<std::uint8_t>(memory_);
}

}  // namespace grove::stream
