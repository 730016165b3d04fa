#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "raster/image.h"
#include "yuv_pictures.h"

namespace grove::stream {

/// A picture with its memory that has smooth parts, edges and fine grain, and moves with `step`.
struct TestPicture {
  TestPicture(int width, int height, int step = 0)
      : pixels(static_cast<std::size_t>(width) * static_cast<std::size_t>(height)) {
    image.rect = {0, 0, width, height};
    image.colour = pixels;
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const int at = x + 3 * step;
        const bool stripe = (at / 40 + y / 40) % 2 == 0;
        const auto grain =
            (static_cast<std::uint32_t>(at) * 2654435761U ^ static_cast<std::uint32_t>(y) * 40503U) >> 27U;
        const auto red = static_cast<std::uint32_t>((at % 400) / 2) + (stripe ? 16U : 0U);
        const auto green = static_cast<std::uint32_t>(y * 200 / height) + (stripe ? grain : 0U);
        const std::uint32_t blue = stripe ? 180U : 60U;
        image.colourRow(y)[x] = red | (green << 8U) | (blue << 16U) | 0xFF000000U;
      }
    }
    yuv_ = tests::yuvOf(image);
  }
  [[nodiscard]] const raster::YuvImage& yuv() const { return *yuv_; }

  std::vector<std::uint32_t> pixels;
  raster::Image image;

 private:
  std::shared_ptr<const raster::YuvImage> yuv_;
};

/// Decibels of red, green and blue.
inline double psnr(std::span<const std::uint32_t> a, std::span<const std::uint32_t> b) {
  if (a.size() != b.size()) return 0.0;
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (const unsigned shift : {0U, 8U, 16U}) {
      const double difference =
          static_cast<double>((a[i] >> shift) & 0xFFU) - static_cast<double>((b[i] >> shift) & 0xFFU);
      sum += difference * difference;
    }
  }
  return 10.0 * std::log10(255.0 * 255.0 * 3.0 * static_cast<double>(a.size()) / std::max(sum, 1e-9));
}

/// A bit stream in a file, for the tools of ffmpeg.
class StreamFile {
 public:
  StreamFile(const std::string& extension, std::span<const std::uint8_t> bytes)
      : path_(::testing::TempDir() + "grove-stream-" + std::to_string(getpid()) + "." + extension) {
    std::ofstream(path_, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  }
  ~StreamFile() {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
  }
  StreamFile(const StreamFile&) = delete;
  StreamFile& operator=(const StreamFile&) = delete;

  /// What a command prints that gets the file's name in place of `@`.
  [[nodiscard]] std::vector<char> run(std::string command) const {
    command.replace(command.find('@'), 1, path_);
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> pipe(::popen(command.c_str(), "r"), ::pclose);
    std::vector<char> output;
    std::vector<char> part(1U << 16U);
    while (const std::size_t read = std::fread(part.data(), 1, part.size(), pipe.get())) {
      output.insert(output.end(), part.data(), part.data() + read);
    }
    return output;
  }
  /// The planes of the pictures, as ffmpeg decodes them: those of the first, and so on.
  [[nodiscard]] std::vector<std::uint8_t> planes() const {
    const std::vector<char> bytes = run("ffmpeg -nostdin -v error -i @ -f rawvideo -vsync 0 -pix_fmt yuvj420p -");
    return {bytes.begin(), bytes.end()};
  }
  /// The pictures, as ffmpeg decodes them; all of the size of the first.
  [[nodiscard]] std::vector<std::uint32_t> pixels() const {
    const std::vector<char> bytes = run("ffmpeg -nostdin -v error -i @ -f rawvideo -vsync 0 -pix_fmt rgba -");
    std::vector<std::uint32_t> pixels(bytes.size() / 4);
    std::memcpy(pixels.data(), bytes.data(), pixels.size() * 4);
    return pixels;
  }

 private:
  const std::string path_;
};

}  // namespace grove::stream
