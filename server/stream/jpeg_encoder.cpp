#include "stream/jpeg_encoder.h"

#include <turbojpeg.h>

#include <algorithm>
#include <cassert>

#include "base/error.h"

namespace grove::stream {

void TurboJpegDeleter::operator()(void* handle) const noexcept { tjDestroy(handle); }

JpegEncoder::JpegEncoder(int quality) : quality_(quality), handle_(tjInitCompress()) {
  assert(quality >= 1 && quality <= 100);
  if (!handle_) throw EnvironmentError(tjGetErrorStr2(nullptr), "JPEG encoder", "");
}

void JpegEncoder::encode(const node::Image& image, std::vector<std::uint8_t>& out) {
  const unsigned long most = tjBufSize(image.width(), image.height(), TJSAMP_420);
  if (most > scratchBytes_) {
    scratch_ = std::make_unique_for_overwrite<unsigned char[]>(most);
    scratchBytes_ = most;
    touchedBytes_ = 0;
  }
  unsigned char* bytes = scratch_.get();
  unsigned long size = scratchBytes_;
  const int pitch = image.width() * static_cast<int>(sizeof(std::uint32_t));
  const int failed = tjCompress2(handle_.get(), reinterpret_cast<const unsigned char*>(image.colour.data()),
                                 image.width(), pitch, image.height(), TJPF_RGBX, &bytes, &size, TJSAMP_420, quality_,
                                 TJFLAG_NOREALLOC | TJFLAG_ACCURATEDCT);
  if (failed != 0) throw EnvironmentError(tjGetErrorStr2(handle_.get()), "JPEG encoder", "");
  touchedBytes_ = std::max(touchedBytes_, size);
  out.insert(out.end(), bytes, bytes + size);
}

}  // namespace grove::stream
