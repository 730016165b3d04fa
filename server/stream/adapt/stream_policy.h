#pragma once

#include <cstdint>
#include <limits>
#include <utility>

#include "stream/encode/encoder.h"
#include "stream/protocol/protocol.h"
#include "world/camera.h"

namespace grove::stream {

/// The best stream that a visitor wants.
struct StreamWish {
  int width = 1280;  ///< of the window, pixels
  int height = 720;
  double framesPerSecond = 30.0;
};

/// The means that the stream has.
struct StreamMeans {
  double bitsPerSecond = 3e6;  ///< available to pictures
  /// Of an ordinary picture at quantiser 0, see QuantiserControl.
  double bitsPerPixel = 4.0;
  /// Maximum of server and browser, however good the line is.
  double framesPerSecond = std::numeric_limits<double>::infinity();
  Quantiser finest = 18.0;  ///< of the encoder
  Quantiser coarsest = 40.0;
  bool isTried = true;  ///< the line has been full before; else its rate is not known yet
};

/// Size and rate of the stream.
struct StreamPlan {
  int width = 1280;
  int height = 720;
  double framesPerSecond = 30.0;
  LimitedBy limitedBy = LimitedBy::kNothing;
  friend bool operator==(const StreamPlan&, const StreamPlan&) = default;
};

/// Chooses size and rate of a visitor's pictures. The quantiser adapts first, elsewhere. Only when it would become too
/// coarse, pictures become smaller, then fewer, and so on; and all of it comes back when there has been room for a
/// while. Not thread-safe.
class StreamPolicy {
 public:
  /// `now`: monotonic seconds. Call at least a few times a second.
  const StreamPlan& update(double now, const StreamWish& wish, const StreamMeans& means);
  [[nodiscard]] const StreamPlan& plan() const noexcept { return plan_; }

 private:
  void step(double now, const StreamWish& wish, const StreamMeans& means);

  std::size_t rung_ = 0;
  double tightSince_ = -1.0;  ///< negative: it is not
  double roomySince_ = -1.0;
  StreamPlan plan_;
};

/// Returns the streamed size for a wanted one: within 160 x 90 to 1920 x 1080, even, of the same shape if possible.
[[nodiscard]] std::pair<int, int> fitSize(std::uint32_t width, std::uint32_t height);

/// Returns the camera that sees more on each side, by `percent` of half the width and height, with the same angle per
/// pixel, as far as fitSize() permits.
[[nodiscard]] world::Camera withBorder(world::Camera camera, int percent);

}  // namespace grove::stream
