#pragma once

#include <cstdint>
#include <cstdio>
#include <memory>
#include <vector>

#include "node/messages.h"
#include "raster/yuv_image.h"

namespace grove::cli {

/// The frames that one visitor saw, 1.4 MB each for 1280 x 720 pixels, in an unlinked temporary file. Not thread-safe.
class KeptFrames {
 public:
  /// Throws EnvironmentError if there is no room for a temporary file.
  KeptFrames(int width, int height);

  /// Throws EnvironmentError if the disk is full.
  void add(const node::FinishedFrame& frame);

  [[nodiscard]] std::size_t count() const noexcept { return views_.size(); }
  [[nodiscard]] int width() const noexcept { return picture_->width(); }
  [[nodiscard]] int height() const noexcept { return picture_->height(); }
  /// Reads a frame, without its labels. The next call overwrites its picture. Throws EnvironmentError if
  /// it cannot be read.
  [[nodiscard]] node::FinishedFrame read(std::size_t index);

 private:
  struct Closer {
    void operator()(std::FILE* file) const noexcept { static_cast<void>(std::fclose(file)); }
  };
  std::unique_ptr<std::FILE, Closer> file_;
  std::vector<std::shared_ptr<const node::View>> views_;
  std::shared_ptr<raster::YuvImage> picture_;
  std::vector<std::shared_ptr<const node::CellNearness>> nearness_;
};

}  // namespace grove::cli
