#include "stream/load/link/segment_losses.h"

#include "stream/load/link/link_random.h"

namespace grove::stream {

// Hashed twice, unlike the jitter's seed, or both would be drawn from the same numbers.
SegmentLosses::SegmentLosses(double share, std::uint64_t seed) : share_(share), state_(mixed(mixed(seed))) {}

int SegmentLosses::next() noexcept {
  int times = 0;
  while (times < kMaxTimes && shareOf(mixed(state_++)) < share_) ++times;
  return times;
}

}  // namespace grove::stream
