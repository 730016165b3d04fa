#include "stream/encode/jpeg/jpeg_compressor.h"

#include <turbojpeg.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "base/error.h"

namespace grove::stream {
namespace {

/// JPEG's unscaled tables (quality 50) correspond to about this quantiser of H.264.
constexpr Quantiser kTablesTimesOne = 30.0;
constexpr int kFinestQuality = 92;
constexpr int kCoarsestQuality = 20;

/// Converts a factor of the tables to the library's quality, and back.
int qualityOf(Quantiser quantiser) {
  const double factor = std::exp2((quantiser - kTablesTimesOne) / 6.0);
  const double quality = factor <= 1.0 ? 100.0 - 50.0 * factor : 50.0 / factor;
  return static_cast<int>(std::lround(std::clamp(quality, 1.0, 100.0)));
}
Quantiser quantiserOf(int quality) {
  const double factor = quality >= 50 ? std::max(0.01, (100.0 - quality) / 50.0) : 50.0 / quality;
  return std::max(0.0, kTablesTimesOne + 6.0 * std::log2(factor));
}

}  // namespace

void TurboJpegDeleter::operator()(void* handle) const noexcept { tjDestroy(handle); }

JpegCompressor::JpegCompressor(int quality) : quality_(quality), handle_(tjInitCompress()) {
  assert(quality >= 1 && quality <= 100);
  if (!handle_) throw EnvironmentError(tjGetErrorStr2(nullptr), "JPEG encoder", "");
}

QuantiserRange JpegCompressor::range() const noexcept {
  return {.finest = quantiserOf(std::max(quality_, kFinestQuality)),
          .usual = quantiserOf(quality_),
          .coarsest = quantiserOf(std::min(quality_, kCoarsestQuality))};
}

void JpegCompressor::compress(const raster::YuvImage& picture, const world::Rect& part, Quantiser quantiser,
                              std::vector<std::uint8_t>& out) {
  const unsigned long max = tjBufSize(part.width(), part.height(), TJSAMP_420);
  if (max > scratchBytes_) {
    scratch_ = std::make_unique_for_overwrite<unsigned char[]>(max);
    scratchBytes_ = max;
    touchedBytes_ = 0;
  }
  unsigned char* bytes = scratch_.get();
  unsigned long size = scratchBytes_;
  const std::ptrdiff_t chroma = picture.chromaAt(part.left, part.top);
  std::array<const unsigned char*, 3> planes{picture.y() + picture.lumaAt(part.left, part.top), picture.u() + chroma,
                                             picture.v() + chroma};
  const std::array<int, 3> strides{picture.width(), picture.width() / 2, picture.width() / 2};
  const int quality = qualityOf(std::clamp(quantiser, range().finest, range().coarsest));
  const int failed = tjCompressFromYUVPlanes(handle_.get(), planes.data(), part.width(), strides.data(), part.height(),
                                             TJSAMP_420, &bytes, &size, quality, TJFLAG_NOREALLOC | TJFLAG_ACCURATEDCT);
  if (failed != 0) throw EnvironmentError(tjGetErrorStr2(handle_.get()), "JPEG encoder", "");
  touchedBytes_ = std::max(touchedBytes_, size);
  out.insert(out.end(), bytes, bytes + size);
}

}  // namespace grove::stream
