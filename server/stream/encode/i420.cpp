#include "stream/encode/i420.h"

#include <libyuv/convert.h>

#include <cassert>

namespace grove::stream {

void I420::assign(const raster::Image& image) {
  width = image.width();
  height = image.height();
  assert(width % 2 == 0 && height % 2 == 0);
  bytes.resize(lumaBytes() + lumaBytes() / 2);
  const auto* rgba = reinterpret_cast<const std::uint8_t*>(image.colour.data());
  // The library names what it reads by the word, not by the bytes: R, G, B, A in memory is its ABGR.
  libyuv::ABGRToI420(rgba, width * 4, y(), width, u(), width / 2, v(), width / 2, width, height);
}

}  // namespace grove::stream
