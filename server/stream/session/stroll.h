#pragma once

#include <cstdint>
#include <deque>
#include <vector>

#include "world/players.h"

namespace grove::stream {

/// Returns the controls, `seconds` after the start, of a measured visitor: a few steps back and forth around the
/// place of arrival, looking along `yaw` (radians) on average. `index` makes visitors differ; two measurements get the
/// same walks. The input has no number yet.
[[nodiscard]] world::Input stroll(int index, float yaw, double seconds);

/// Measures the time from sending an input to the first frame that shows it. Not thread-safe.
class InputLatency {
 public:
  void sent(std::uint32_t input, double now) { unseen_.push_back({input, now}); }

  /// A frame came that shows `lastInput` and all before it. Appends one value to `milliseconds` for each of them that
  /// no frame has shown before.
  void shown(std::uint32_t lastInput, double now, std::vector<float>& milliseconds);

 private:
  struct Sent {
    std::uint32_t input;
    double time;
  };
  std::deque<Sent> unseen_;
};

}  // namespace grove::stream
