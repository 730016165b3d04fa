#pragma once

#include <cstdint>
#include <cstdio>
#include <memory>
#include <vector>

#include "raster/yuv_image.h"
#include "world/camera.h"

namespace grove::cli {

/// The frames that one visitor saw, 1.4 MB each for 1280 x 720 pixels, in an unlinked temporary file. Not thread-safe.
class KeptFrames {
 public:
  /// Throws EnvironmentError if there is no room for a temporary file.
  KeptFrames(int width, int height);

  /// Throws EnvironmentError if the disk is full.
  void add(const world::Pose& pose, const raster::YuvImage& image);

  [[nodiscard]] std::size_t count() const noexcept { return poses_.size(); }
  [[nodiscard]] int width() const noexcept { return image_.width(); }
  [[nodiscard]] int height() const noexcept { return image_.height(); }
  [[nodiscard]] const world::Pose& pose(std::size_t index) const { return poses_[index]; }
  /// Reads a frame into memory; valid until the next call. Throws EnvironmentError if it cannot be read.
  [[nodiscard]] const raster::YuvImage& read(std::size_t index);

 private:
  struct Closer {
    void operator()(std::FILE* file) const noexcept { static_cast<void>(std::fclose(file)); }
  };
  std::unique_ptr<std::FILE, Closer> file_;
  std::vector<world::Pose> poses_;
  std::vector<std::uint8_t> bytes_;
  raster::YuvImage image_;
};

}  // namespace grove::cli
