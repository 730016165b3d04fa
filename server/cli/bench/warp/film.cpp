#include "cli/bench/warp/film.h"

#include "base/error.h"

namespace grove::cli {
namespace {

/// The mean of four colours.
std::uint32_t meanOf(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
  std::uint32_t mean = 0;
  for (unsigned shift = 0; shift < 32; shift += 8) {
    const auto channel = [shift](std::uint32_t colour) { return colour >> shift & 0xFFU; };
    mean |= (channel(a) + channel(b) + channel(c) + channel(d) + 2) / 4 << shift;
  }
  return mean;
}

}  // namespace

Film::Film(const std::string& file, const PictureSize& size) : name_(file), size_(size), file_(file, std::ios::binary) {
  const int width = size.width / 4 * 2;
  both_.rect = {0, 0, 2 * width, size.height / 4 * 2};
  planes_.rect = both_.rect;
  colours_.resize(planes_.lumaBytes());
  bytes_.resize(planes_.lumaBytes() / 2 * 3);
  both_.colour = colours_;
  planes_.bytes = bytes_;
  file_ << "YUV4MPEG2 W" << both_.width() << " H" << both_.height() << " F60:1 Ip A1:1 C420jpeg XCOLORRANGE=FULL\n";
  check();
}

void Film::add(std::span<const std::uint32_t> left, std::span<const std::uint32_t> right) {
  shrink(left, 0);
  shrink(right, both_.width() / 2);
  raster::toYuv(both_, both_.rect, planes_);
  file_ << "FRAME\n";
  file_.write(reinterpret_cast<const char*>(bytes_.data()), static_cast<std::streamsize>(bytes_.size()));
  check();
}

void Film::shrink(std::span<const std::uint32_t> view, int offset) {
  const auto width = static_cast<std::size_t>(size_.width);
  for (int y = 0; y < both_.height(); ++y) {
    const std::uint32_t* const rows = view.data() + 2 * width * static_cast<std::size_t>(y);
    std::uint32_t* const out = colours_.data() + static_cast<std::size_t>(both_.width()) * static_cast<std::size_t>(y) +
                               static_cast<std::size_t>(offset);
    for (std::size_t x = 0; x < static_cast<std::size_t>(both_.width()) / 2; ++x) {
      out[x] = meanOf(rows[2 * x], rows[2 * x + 1], rows[width + 2 * x], rows[width + 2 * x + 1]);
    }
  }
}

void Film::check() {
  if (!file_) throw EnvironmentError("cannot write the film", name_, "is there room on its disk?");
}

}  // namespace grove::cli
