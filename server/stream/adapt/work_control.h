#pragma once

#include <limits>
#include <optional>

#include "stream/adapt/governor.h"
#include "stream/adapt/relief.h"
#include "stream/adapt/shortage.h"
#include "stream/adapt/stream_policy.h"
#include "stream/protocol/protocol.h"

namespace grove::stream {

class LinkEstimator;

/// Measures the rate that server and browser achieve for one visitor's stream, which of line, server and browser is the
/// bottleneck, and how far a slow browser is relieved. Not thread-safe; times are monotonic seconds.
class WorkControl {
 public:
  WorkControl();

  /// The page reported a frame as painted this long after its arrival.
  void held(double seconds);
  /// A due frame is delayed: too many are unacknowledged.
  void waitsForPage(const LinkEstimator& link, double now);
  void waitsForServer(double now) { shortage_.blocked(LimitedBy::kMachine, now); }
  /// A frame begins. Returns how long it waited for the server, seconds.
  double begins(double now) { return shortage_.began(now); }
  void rest() { shortage_.rest(); }

  /// How the machine keeps up with `wanted` frames a second; nothing if line or browser keep frames back, too. `moves`:
  /// the page moves pictures.
  [[nodiscard]] std::optional<Governor::Pace> pace(double wanted, bool moves, double now) const;
  /// Returns the wish, reduced by the browser's relief. Call at least a few times a second.
  [[nodiscard]] StreamWish relieve(StreamWish wish, double now);
  /// Maximum frames a second of server and browser; infinite if the line limits the stream.
  [[nodiscard]] double framesPerSecond() const noexcept { return framesPerSecond_; }
  /// The bottleneck, updated twice a second, so that it does not flicker.
  [[nodiscard]] LimitedBy shortOf() const noexcept { return shortOf_; }
  [[nodiscard]] bool sparesBrowser() const noexcept { return browser_.isActive(); }

 private:
  Shortage shortage_;
  Relief browser_;
  double held_ = 0.0;  ///< smoothed seconds
  double framesPerSecond_ = std::numeric_limits<double>::infinity();
  LimitedBy shortOf_ = LimitedBy::kNothing;
  double judged_ = 0.0;
};

}  // namespace grove::stream
