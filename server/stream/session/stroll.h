#pragma once

#include <cstdint>
#include <deque>
#include <vector>

#include "world/players.h"

namespace grove::stream {

/// The controls, so many seconds after he began, of a visitor who walks and looks about for a measurement: a few steps
/// this way and that around the place where he arrived, looking along `yaw` (radians) on the mean. `index` makes
/// visitors differ; two measurements get the same walks. The input has no number yet.
[[nodiscard]] world::Input stroll(int index, float yaw, double seconds);

/// How long it takes from sending an input to the first frame that shows it. One thread at a time.
class InputLatency {
 public:
  void sent(std::uint32_t input, double now) { unseen_.push_back({input, now}); }

  /// A frame came that shows `lastInput` and all before it; `milliseconds` gets one value for each that no frame has
  /// shown yet.
  void shown(std::uint32_t lastInput, double now, std::vector<float>& milliseconds);

 private:
  struct Sent {
    std::uint32_t input;
    double time;
  };
  std::deque<Sent> unseen_;
};

}  // namespace grove::stream
