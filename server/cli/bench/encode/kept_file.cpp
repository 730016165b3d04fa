#include "cli/bench/encode/kept_file.h"

#include <string>
#include <string_view>

namespace grove::cli {
namespace {

std::span<const std::uint8_t> bytesOf(std::string_view text) {
  return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

}  // namespace

void KeptFile::append(std::span<const std::uint8_t> bytes) {
  file_.write(bytes_, std::as_bytes(bytes));
  bytes_ += bytes.size();
}

// C420jpeg says where chroma lies, not the range; readers of XCOLORRANGE are FFmpeg and libavif.
KeptFilm::KeptFilm(const std::filesystem::path& file, const PictureSize& size) : file_(file) {
  const std::string header = "YUV4MPEG2 W" + std::to_string(size.width) + " H" + std::to_string(size.height) +
                             " F30:1 Ip A1:1 C420jpeg XCOLORRANGE=FULL\n";
  file_.append(bytesOf(header));
}

void KeptFilm::add(const raster::YuvImage& frame) {
  file_.append(bytesOf("FRAME\n"));
  file_.append(std::span(frame.bytes));
}

}  // namespace grove::cli
