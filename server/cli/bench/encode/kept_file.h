#pragma once

#include <cstdint>
#include <filesystem>
#include <span>

#include "base/atomic_file.h"
#include "cli/bench/picture_size.h"
#include "raster/yuv_image.h"

namespace grove::cli {

/// A file that grows at its end, and appears when it is complete. One thread.
class KeptFile {
 public:
  /// Throws EnvironmentError, as all members do, that names the file.
  explicit KeptFile(const std::filesystem::path& file) : file_(file) {}

  void append(std::span<const std::uint8_t> bytes);
  /// Called once, last.
  void commit() { file_.commit(); }

 private:
  AtomicFile file_;
  std::uint64_t bytes_ = 0;
};

/// Frames for other programs, 30 per second: YUV4MPEG2, which keeps every value. One thread.
class KeptFilm {
 public:
  /// Throws EnvironmentError, as all members do, that names the file.
  KeptFilm(const std::filesystem::path& file, const PictureSize& size);

  void add(const raster::YuvImage& frame);
  /// Called once, last.
  void commit() { file_.commit(); }

 private:
  KeptFile file_;
};

}  // namespace grove::cli
