// Positions of the samples of a backdrop's cells. For kernels: included once per target.

#if defined(GROVE_NODE_FRONTEND_BACKDROPS_WARP_PLACES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef GROVE_NODE_FRONTEND_BACKDROPS_WARP_PLACES_INL_H
#undef GROVE_NODE_FRONTEND_BACKDROPS_WARP_PLACES_INL_H
#else
#define GROVE_NODE_FRONTEND_BACKDROPS_WARP_PLACES_INL_H
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "base/simd/lanes_inl.h"
#include "node/frontend/backdrops/backdrop_kernels.h"

HWY_BEFORE_NAMESPACE();
namespace grove::node::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
namespace lanes = grove::simd::HWY_NAMESPACE;
using lanes::Floats;
using lanes::Ints;
using lanes::kLanes;

/// The corners of one row of pixels.
struct RowCorners {
  float x[kCorners];
  float y[kCorners];

  HWY_INLINE RowCorners(const CornerLine& above, const CornerLine& below, float down) {
    for (int i = 0; i < kCorners; ++i) {
      x[i] = above.x[i] + down * (below.x[i] - above.x[i]);
      y[i] = above.y[i] + down * (below.y[i] - above.y[i]);
    }
  }
};

/// Positions within a block are in steps of a sample, as 16-bit integers.
inline constexpr int kPlaceBits = 11;
inline constexpr int kPlaceSteps = 1 << kPlaceBits;

/// Positions of one row of samples of the cells, `kSide` samples each. For each cell: the block of 16 bytes that holds
/// them, the first sample's position in it, and the step from sample to sample.
template <int kSide>
struct RowPlaces {
  static constexpr int kBytes = 8 / kSide;  ///< of a sample: 1 of luma, 2 of both chroma
  static constexpr int kBlock = 16 / kBytes;

  // Loads of eight may begin at the last.
  static constexpr int kWords = kWarpCells + 8;
  alignas(64) std::int16_t x[kWords];
  std::int16_t xStep[kWords];
  std::int16_t y[kWords];
  std::int16_t yStep[kWords];
  std::int32_t block[kWarpCells];  ///< bytes from the plane's begin

  /// Fills in the positions in a plane of `width` x `height` samples. Returns a bit for each cell that is stretched
  /// beyond a block and the two below it.
  HWY_INLINE std::uint32_t find(const RowCorners& corners, int width, int height) {
    std::uint32_t stretched = 0;
    for (int i = 0; i < kWarpCells; i += kLanes) {
      const Along across(corners.x + i, width - kBlock);
      const Along down(corners.y + i, height - 3);
      across.store(x + i, xStep + i);
      down.store(y + i, yStep + i);
      lanes::store((down.first * width + across.first) * kBytes, block + i);
      stretched |= bitsOf((lanes::abs(across.step) > kMaxStep) | (lanes::abs(down.step) > kMaxRise)) << unsigned(i);
    }
    return stretched;
  }

 private:
  /// All of a row's samples lie within a block, or on two lines.
  static constexpr float kMaxStep = (kBlock - 2.0F) / (kSide - 1);
  static constexpr float kMaxRise = 1.0F / (kSide - 1);

  HWY_INLINE static std::uint32_t bitsOf(lanes::Mask mask) {
    std::uint8_t bytes[8] = {};
    hn::StoreMaskBits(lanes::FloatTag(), mask.raw, bytes);
    return bytes[0] | static_cast<std::uint32_t>(bytes[1]) << 8U;
  }

  /// One coordinate.
  struct Along {
    Floats step;   ///< from sample to sample
    Ints first;    ///< column or line of the block
    Floats place;  ///< of the first sample, from there

    HWY_INLINE Along(const float* corners, int max) {
      // To the nearest 128th, as weights are: without motion places are whole.
      constexpr float kRounding = 0.5F / 128.0F;
      const Floats begin = lanes::load(corners);
      step = (lanes::load(corners + 1) - begin) * 0.125F;
      const Floats at = lanes::mulAdd(begin, kSide / 8.0F, lanes::mulAdd(step, 0.5F, kRounding - 0.5F));
      const Floats least = lanes::min(at, lanes::mulAdd(step, kSide - 1.0F, at));
      first = lanes::truncate(lanes::clamp(least, 0.0F, static_cast<float>(max)));
      place = at - lanes::toFloats(first);
    }

    HWY_INLINE void store(std::int16_t* places, std::int16_t* steps) const {
      const hn::Rebind<std::int16_t, lanes::IntTag> words;
      constexpr float kSteps = kPlaceSteps;
      hn::StoreU(hn::DemoteTo(words, hn::NearestInt((step * kSteps).raw)), words, steps);
      // Saturates: the image repeats its edges.
      hn::StoreU(hn::DemoteTo(words, lanes::truncate(place * kSteps).raw), words, places);
    }
  };
};

}  // namespace grove::node::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // once per target
