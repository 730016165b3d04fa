#pragma once

#include "stream/encode/h264/macroblock_pixels.h"

namespace grove::stream::h264 {

/// Chooses the quantisers of macroblocks: finer where the picture is smooth, coarser where it is busy, since a busy
/// part hides errors. Like x264's variance-based adaptive quantisation (`aq-mode 1`), but around the mean of the last
/// picture instead of a constant, so that a picture's mean quantiser is the wanted one.
class AdaptiveQuantiser {
 public:
  /// Steps per doubling of the luma's variance; six of them double the step size of the quantisation.
  static constexpr float kStrength = 1.0F;
  /// Largest difference from the picture's quantiser.
  static constexpr float kMaxOffset = 6.0F;

  void nextPicture();
  /// `quantiser` is that of the picture.
  [[nodiscard]] int choose(const MacroblockPixels& source, int quantiser);

 private:
  float mean_ = 8.0F;  ///< binary logarithm of the variance, mean of the last picture; at first that of a meadow
  float sum_ = 0.0F;
  int count_ = 0;
};

}  // namespace grove::stream::h264
