// Cells of a warped backdrop that are stretched too much for a register. For kernels: included once per target.

#if defined(GROVE_NODE_FRONTEND_BACKDROPS_WARP_STRETCHED_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef GROVE_NODE_FRONTEND_BACKDROPS_WARP_STRETCHED_INL_H
#undef GROVE_NODE_FRONTEND_BACKDROPS_WARP_STRETCHED_INL_H
#else
#define GROVE_NODE_FRONTEND_BACKDROPS_WARP_STRETCHED_INL_H
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "node/frontend/backdrops/backdrop_kernels.h"

HWY_BEFORE_NAMESPACE();
namespace grove::node::HWY_NAMESPACE {

/// Bilinear look-ups of one cell's samples in a plane, with weights in 128ths. Compilers vectorise all loops except the
/// one that loads.
template <int kSide>
class StretchedSamples {
 public:
  /// Distance of neighbours: 1 byte of luma, 2 of chroma.
  static constexpr int kBytes = 8 / kSide;

  HWY_INLINE StretchedSamples(const CornerLine& above, const CornerLine& below, int cell, int width, int height)
      : stride_(std::ptrdiff_t{width} * kBytes) {
    constexpr float kScale = kSide / 8.0F;
    constexpr float kStep = 1.0F / kSide;
    // Before the last sample, so that there is a next one.
    const float maxColumn = static_cast<float>(width) - 1.01F;
    const float maxLine = static_cast<float>(height) - 1.01F;
    const auto mixed = [](float a, float b, float share) { return a + share * (b - a); };
    for (int row = 0; row < kSide; ++row) {
      const float lower = (static_cast<float>(row) + 0.5F) * kStep;
      const float leftX = mixed(above.x[cell], below.x[cell], lower) * kScale - 0.5F;
      const float leftY = mixed(above.y[cell], below.y[cell], lower) * kScale - 0.5F;
      const float rightX = mixed(above.x[cell + 1], below.x[cell + 1], lower) * kScale - 0.5F;
      const float rightY = mixed(above.y[cell + 1], below.y[cell + 1], lower) * kScale - 0.5F;
      for (int i = 0; i < kSide; ++i) {
        const float across = (static_cast<float>(i) + 0.5F) * kStep;
        const float x = std::min(std::max(mixed(leftX, rightX, across), 0.0F), maxColumn);
        const float y = std::min(std::max(mixed(leftY, rightY, across), 0.0F), maxLine);
        const int column = static_cast<int>(x);
        const int line = static_cast<int>(y);
        at_[row * kSide + i] = (line * width + column) * kBytes;
        right_[row * kSide + i] = static_cast<int>((x - static_cast<float>(column)) * 128.0F);
        down_[row * kSide + i] = static_cast<int>((y - static_cast<float>(line)) * 128.0F);
      }
    }
  }

  HWY_INLINE void lookUp(const std::uint8_t* plane, std::uint8_t* out, std::ptrdiff_t outStride) const {
    int aboveLeft[kCount];
    int aboveRight[kCount];
    int belowLeft[kCount];
    int belowRight[kCount];
    for (int i = 0; i < kCount; ++i) {
      const std::uint8_t* const from = plane + at_[i];
      aboveLeft[i] = from[0];
      aboveRight[i] = from[kBytes];
      belowLeft[i] = from[stride_];
      belowRight[i] = from[stride_ + kBytes];
    }
    std::uint8_t samples[kCount];
    for (int i = 0; i < kCount; ++i) {
      const int above = aboveLeft[i] * (128 - right_[i]) + aboveRight[i] * right_[i];
      const int below = belowLeft[i] * (128 - right_[i]) + belowRight[i] * right_[i];
      samples[i] = static_cast<std::uint8_t>((above * (128 - down_[i]) + below * down_[i] + 8192) >> 14);
    }
    for (int row = 0; row < kSide; ++row) std::copy_n(samples + row * kSide, kSide, out + row * outStride);
  }

 private:
  static constexpr int kCount = kSide * kSide;
  std::ptrdiff_t stride_;
  int at_[kCount];
  int right_[kCount];
  int down_[kCount];
};

/// Colours of one cell.
HWY_INLINE void warpStretched(const WarpSource& source, const CornerLine& above, const CornerLine& below, int cell,
                              const WarpedPixels& out) {
  const StretchedSamples<8> luma(above, below, cell, source.width, source.height);
  luma.lookUp(source.y, out.y + cell * 8, out.stride);
  const StretchedSamples<4> chroma(above, below, cell, source.width / 2, source.height / 2);
  chroma.lookUp(source.uv, out.u + cell * 4, out.stride / 2);
  chroma.lookUp(source.uv + 1, out.v + cell * 4, out.stride / 2);
}

}  // namespace grove::node::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // once per target
