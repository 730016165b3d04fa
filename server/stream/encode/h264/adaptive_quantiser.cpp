#include "stream/encode/h264/adaptive_quantiser.h"

#include <algorithm>
#include <cmath>

#include "stream/encode/h264/residual/quantisation.h"
#include "stream/encode/h264/variance_kernels.h"

namespace grove::stream::h264 {
namespace {

/// Variance that is noise: smoother macroblocks are not encoded more finely.
constexpr float kNoise = 4.0F;

}  // namespace

void AdaptiveQuantiser::nextPicture() {
  if (count_ > 0) mean_ = sum_ / static_cast<float>(count_);
  sum_ = 0.0F;
  count_ = 0;
}

int AdaptiveQuantiser::choose(const MacroblockPixels& source, int quantiser) {
  const float activity = std::log2(std::max(varianceOf(source), 0.0F) + kNoise);
  sum_ += activity;
  ++count_;
  const float wanted =
      static_cast<float>(quantiser) + std::clamp(kStrength * (activity - mean_), -kMaxOffset, kMaxOffset);
  return std::clamp(static_cast<int>(std::lround(wanted)), 0, kMaxQuantiser);
}

}  // namespace grove::stream::h264
