#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "stream/adapt/border_choice.h"
#include "stream/adapt/capture_request.h"
#include "stream/adapt/codec_choice.h"
#include "stream/adapt/frame_times.h"
#include "stream/adapt/governor.h"
#include "stream/adapt/link_estimator.h"
#include "stream/adapt/stream_policy.h"
#include "stream/adapt/work_control.h"
#include "stream/encode/encoder.h"
#include "stream/encode/encoder_registry.h"
#include "stream/encode/quantiser_control.h"
#include "stream/protocol/protocol.h"
#include "world/camera.h"

namespace grove::stream {

/// What a page supports, by its sub-protocol.
enum class PageLevel : std::uint8_t {
  kBasic,     ///< before v1.2: JPEG of the wanted size and the usual quality; only the number of frames in flight
              ///< adapts to the line
  kAdaptive,  ///< v1.2
  kTimed,     ///< v1.3: reports the browser's time for frames
  kNaming,    ///< v1.4: writes names over the picture
  kMoving,    ///< v1.5: moves pictures to where the visitor walks (late walk)
};

/// Controls one visitor's stream: codec, size, rate, quantiser, and the number of frames in flight. It follows the
/// visitor's wish, the line's rate, the speed of server and browser, and the complexity of the pictures. Thread-safe;
/// times are seconds of pipeline::wallSeconds().
class StreamControl {
 public:
  /// `encoders` outlives it.
  StreamControl(const EncoderRegistry& encoders, std::shared_ptr<Governor> governor, PageLevel page,
                double framesPerSecond, int width, int height);

  // The visitor's messages.
  void resize(int width, int height);
  void offer(std::vector<std::uint8_t> codecs);
  void limit(const Limits& limits);
  /// The page cannot decode a frame.
  void broken();
  /// Requests one frame as a capture with this number.
  void capture(std::uint32_t number);
  /// Returns false if the frame was never sent.
  [[nodiscard]] bool acknowledged(std::uint32_t frame, const Arrival& arrival);
  /// Seconds since the last acknowledgement; 0 if no frame is unacknowledged.
  [[nodiscard]] double secondsUnacknowledged(double now) const;

  /// Whether the page moves pictures, and needs the nearness of their surfaces.
  [[nodiscard]] bool wantsNearness() const;
  /// Time from reading a camera to the picture on the page's screen, seconds; 0 for pages that do not move pictures.
  [[nodiscard]] double leadSeconds() const;
  /// The least of that without the line: drawing, encoding, decoding and waiting for the display.
  static constexpr double kDrawingSeconds = 0.020;

  // Before a frame.
  /// Returns whether a due frame may begin while `beingMade` others are in progress.
  [[nodiscard]] bool mayBegin(double now, int beingMade);
  /// A due frame waits for the server.
  void waitsForServer(double now);
  void begins(double now);
  [[nodiscard]] double framesPerSecond() const;
  /// Returns whether the page is hidden: then no frame begins.
  [[nodiscard]] bool isHidden() const;
  /// Sets size and angle of this frame's camera; returns the border, percent.
  int aim(world::Camera& camera, std::uint32_t frame, double now);
  /// Returns the capture's number if this frame is a capture; once.
  [[nodiscard]] std::optional<std::uint32_t> takeCapture(std::uint32_t frame);

  // Its picture.
  struct Choice {
    const EncoderKind* kind;
    EncodeOrder order;
    double bytes;  ///< available to it
  };
  /// Returns the encoder for it. One that failed is not chosen again.
  [[nodiscard]] const EncoderKind& kind() const;
  void failed(const EncoderKind& kind);
  /// `still`: the camera has not moved since the last picture; `same`: no pixel has changed.
  [[nodiscard]] Choice choose(const EncoderKind& kind, const QuantiserRange& range, double pixels, bool still,
                              bool same, double now);
  void encoded(const Choice& choice, bool independent, double pixels, std::size_t bytes);
  /// Records the seconds that a frame spent there.
  void took(FrameTimes::Place place, double seconds);
  /// The page already shows what would be sent.
  void unchanged(std::uint32_t lastInput);
  /// `allowed`: bytes that were available to it.
  void sent(std::uint32_t frame, std::uint32_t lastInput, std::size_t bytes, double allowed, double now);
  /// The socket took all of it at `now`; the writing thread reached it at `reached`.
  void written(std::uint32_t frame, double reached, double now);

  /// Returns the status to send now, if any; `visitors`: number in the world.
  [[nodiscard]] std::optional<Status> takeStatus(double now, std::size_t visitors);
  /// Returns the times to send now, if any.
  [[nodiscard]] std::optional<Times> takeTimes(double now);
  /// The present status, for reports.
  [[nodiscard]] Status status() const;

 private:
  /// The visitor's wish, as far as the machine allows.
  [[nodiscard]] StreamWish wish(const Governor::Share& share) const;
  /// The page moves pictures.
  [[nodiscard]] bool moves() const;
  /// The machine is too busy for the visitor's wish.
  [[nodiscard]] bool isGoverned() const;
  [[nodiscard]] double bitsPerSecond() const;
  /// The visitor's own limit.
  [[nodiscard]] double wantedBitsPerSecond() const;
  void took(FrameTimes::Place place, double seconds, const std::lock_guard<std::mutex>& held);
  [[nodiscard]] Status statusNow() const;
  [[nodiscard]] LimitedBy limitedBy() const;
  void plan(double now);
  void planCodec(double now);
  void planBorder();

  const EncoderRegistry& encoders_;
  const PageLevel page_;
  const double serverFramesPerSecond_;

  mutable std::mutex mutex_;
  int width_;
  int height_;
  std::vector<std::uint8_t> offer_{kCodecJpeg};
  std::vector<std::uint8_t> failed_;
  Limits limits_;
  LinkEstimator link_;
  StreamPolicy policy_;
  WorkControl work_;
  Governor::Stream governed_;
  CodecChoice codecChoice_;
  double moved_ = 0.0;  ///< the camera moved last then
  FrameTimes times_;
  BorderChoice border_;
  QuantiserControl quantisers_;
  QuantiserRange range_;
  Quantiser newestQuantiser_ = 30.0;
  bool wantsIndependent_ = true;
  double independentMade_ = -1.0;  ///< the last requested one
  CaptureRequest capture_;
  std::uint32_t newestSent_ = 0;
  double unacknowledgedSince_ = 0.0;  ///< if any frame is
  std::uint32_t lastInput_ = 0;       ///< shown by the page's picture
  std::uint32_t lastInputReported_ = 0;
  double wordSince_ = 0.0;  ///< when any message was last sent
  Status reported_;
};

}  // namespace grove::stream
