#pragma once

#include <chrono>
#include <vector>

#include "stream/load/link/descriptor.h"

namespace grove::stream {

/// Says whose input is due: that of each session once a period, the sessions spread evenly over the period, at most one
/// wake-up a millisecond. It is a descriptor to poll, because libwebsockets does not sleep through the last millisecond
/// before one of its own timers is due. One thread.
class InputClock {
 public:
  /// Throws EnvironmentError if no timer is left.
  InputClock(int sessions, std::chrono::milliseconds period);

  /// A descriptor of the same timer for a poll set that closes what it polls. Readable while inputs are due. Throws
  /// EnvironmentError if no descriptor is left.
  [[nodiscard]] int duplicate() const;

  /// The sessions whose inputs have become due since the last call. A session that has missed some is named once.
  [[nodiscard]] std::vector<int> takeDue();

 private:
  int sessions_;
  int turns_;  ///< of a period; sessions of one turn are turns_ apart
  int turn_ = 0;
  Descriptor timer_;
};

}  // namespace grove::stream
