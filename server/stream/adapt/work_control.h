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

/// Learns what server and browser manage of one visitor's stream, who of line, server and browser is short, and what
/// the browser is to be spared. One thread at a time; times are seconds that do not go back.
class WorkControl {
 public:
  WorkControl();

  /// The page had a frame for so long before it reported that it was painted.
  void held(double seconds);
  /// A frame that is due may not begin: too many wait to be acknowledged.
  void waitsForPage(const LinkEstimator& link, double now);
  void waitsForServer(double now) { shortage_.blocked(LimitedBy::kMachine, now); }
  /// Returns how long the frame waited for the server, seconds.
  double begins(double now) { return shortage_.began(now); }
  void rest() { shortage_.rest(); }

  /// How the machine keeps up with `wanted` frames a second; nothing if line or browser keep frames back, too.
  [[nodiscard]] std::optional<Governor::Pace> pace(double wanted, double now) const;
  /// What remains of a wish with what the browser is spared. To be asked a few times a second at least.
  [[nodiscard]] StreamWish relieve(StreamWish wish, double now);
  /// Frames a second that server and browser manage at most; infinite where the line is what limits them.
  [[nodiscard]] double framesPerSecond() const noexcept { return framesPerSecond_; }
  /// Who is short, as judged twice a second; so it does not flicker.
  [[nodiscard]] LimitedBy shortOf() const noexcept { return shortOf_; }
  [[nodiscard]] bool sparesBrowser() const noexcept { return browser_.isGiven(); }

 private:
  Shortage shortage_;
  Relief browser_;
  double held_ = 0.0;  ///< usually; seconds
  double framesPerSecond_ = std::numeric_limits<double>::infinity();
  LimitedBy shortOf_ = LimitedBy::kNothing;
  double judged_ = 0.0;
};

}  // namespace grove::stream
