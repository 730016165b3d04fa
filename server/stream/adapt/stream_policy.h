#pragma once

#include <cstdint>
#include <limits>
#include <utility>

#include "stream/encode/encoder.h"
#include "stream/protocol/protocol.h"

namespace grove::stream {

/// What a stream could be at best.
struct StreamWish {
  int width = 1280;  ///< of the window, pixels
  int height = 720;
  double framesPerSecond = 30.0;
};

/// What it has to do with.
struct StreamMeans {
  double bitsPerSecond = 3e6;  ///< that pictures may take
  /// Of an ordinary picture at quantiser 0, as QuantiserControl has it.
  double bitsPerPixel = 4.0;
  /// That server and browser manage at most, however good the line is.
  double framesPerSecond = std::numeric_limits<double>::infinity();
  Quantiser finest = 18.0;  ///< of the encoder
  Quantiser coarsest = 40.0;
  bool isTried = true;  ///< the line has been full before; else it is not known yet what it carries
};

/// What it is.
struct StreamPlan {
  int width = 1280;
  int height = 720;
  double framesPerSecond = 30.0;
  LimitedBy limitedBy = LimitedBy::kNothing;
  friend bool operator==(const StreamPlan&, const StreamPlan&) = default;
};

/// Decides size and rate of a visitor's pictures. The quantiser gives way first, which is not decided here: only when
/// it would have to be coarser than pleases, pictures become smaller, then fewer, and again; and all of it comes back
/// when there is room for a while. One thread at a time.
class StreamPolicy {
 public:
  /// At `now`, seconds. To be asked a few times a second at least.
  const StreamPlan& update(double now, const StreamWish& wish, const StreamMeans& means);
  [[nodiscard]] const StreamPlan& plan() const noexcept { return plan_; }

 private:
  void step(double now, const StreamWish& wish, const StreamMeans& means);

  std::size_t rung_ = 0;
  double tightSince_ = -1.0;  ///< negative: it is not
  double roomySince_ = -1.0;
  StreamPlan plan_;
};

/// The size that is streamed for a wanted one: within 160 x 90 to 1920 x 1080, even, of the same shape where possible.
[[nodiscard]] std::pair<int, int> fitSize(std::uint32_t width, std::uint32_t height);

}  // namespace grove::stream
