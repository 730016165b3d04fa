#pragma once

#include <cstdint>

namespace grove::stream::h264 {

/// How far the deblocking filter goes at some quantiser (ITU-T H.264, 8.7.2.2 and 8.7.2.3, both offsets 0).
struct alignas(8) DeblockingLimits {
  /// A byte for each strength from 0 to 3, the lowest for 0: 1 more than the standard's tC0, and 0 for strength 0.
  std::uint32_t clips = 0;
  /// Filters only where the pixels beside the edge differ by less than alpha, and from their neighbours by less than
  /// beta. Both are 0 where nothing is filtered, else neither.
  std::uint8_t alpha = 0;
  std::uint8_t beta = 0;
};

/// `quantiser` is the mean of both sides' quantisers, for chroma of their chroma's.
[[nodiscard]] const DeblockingLimits& deblockingLimits(int quantiser);

}  // namespace grove::stream::h264
