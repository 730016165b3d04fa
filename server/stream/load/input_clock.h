#pragma once

#include <chrono>
#include <vector>

#include "stream/load/link/descriptor.h"

namespace grove::stream {

/// Clock of the sessions' inputs: each session's input is due once a period; the sessions are spread evenly over the
/// period, with at most one wake-up per millisecond. It is a descriptor to poll, because libwebsockets does not sleep
/// through the last millisecond before one of its own timers is due. Not thread-safe.
class InputClock {
 public:
  /// Throws EnvironmentError if no timer is left.
  InputClock(int sessions, std::chrono::milliseconds period);

  /// Returns another descriptor of the timer, for a poll set that closes its descriptors. Readable while inputs are
  /// due. Throws EnvironmentError if no descriptor is left.
  [[nodiscard]] int duplicate() const;

  /// Returns the sessions whose inputs have become due since the last call; each once, even if it has missed some.
  [[nodiscard]] std::vector<int> takeDue();

 private:
  int sessions_;
  int turns_;  ///< per period; the sessions of one turn are turns_ apart
  int turn_ = 0;
  Descriptor timer_;
};

}  // namespace grove::stream
