#pragma once

#include <cstdint>
#include <fstream>
#include <span>
#include <string>
#include <vector>

#include "cli/bench/picture_size.h"
#include "raster/image.h"
#include "raster/yuv_image.h"

namespace grove::cli {

/// A film of two views side by side, each at half its width and height, for the eye: YUV4MPEG2, which players and
/// converters read, 60 frames per second. Not thread-safe.
class Film {
 public:
  /// `size`: of each view. Throws EnvironmentError if the file cannot be written.
  Film(const std::string& file, const PictureSize& size);

  /// RGBA, row by row. Throws EnvironmentError if the disk is full.
  void add(std::span<const std::uint32_t> left, std::span<const std::uint32_t> right);

 private:
  void shrink(std::span<const std::uint32_t> view, int offset);
  void check();

  const std::string name_;
  const PictureSize size_;
  std::ofstream file_;
  std::vector<std::uint32_t> colours_;
  std::vector<std::uint8_t> bytes_;
  raster::Image both_;       ///< of these colours
  raster::YuvImage planes_;  ///< of these bytes
};

}  // namespace grove::cli
