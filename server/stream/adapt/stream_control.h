#pragma once

#include <cstdint>
#include <mutex>
#include <optional>
#include <vector>

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

/// What a page understands, by its sub-protocol.
enum class PageLevel : std::uint8_t {
  kBasic,     ///< before v1.2: pictures of the wanted size in JPEG of the usual quality; only how many are under way
              ///< follows the line
  kAdaptive,  ///< v1.2
  kTimed,     ///< v1.3: reports what the browser spends on frames
  kNaming,    ///< v1.4: writes names over the picture
};

/// What leads one visitor's stream: codec, size, rate, quantiser, and how many frames are under way; from what he
/// wants, what his line carries, what server and browser manage and what the pictures are like. Any thread; times are
/// seconds of pipeline::wallSeconds().
class StreamControl {
 public:
  /// `encoders` and `governor` outlive it.
  StreamControl(const EncoderRegistry& encoders, Governor& governor, PageLevel page, double framesPerSecond, int width,
                int height);

  // What the visitor says.
  void resize(int width, int height);
  void offer(std::vector<std::uint8_t> codecs);
  void limit(const Limits& limits);
  /// A frame cannot be decoded.
  void broken();
  /// One frame is to be a capture, which goes by this number.
  void capture(std::uint32_t number);
  /// False: it was never sent.
  [[nodiscard]] bool acknowledged(std::uint32_t frame, const Arrival& arrival);
  /// How long frames have been waiting to be acknowledged, seconds, since one was last; 0 if there is none.
  [[nodiscard]] double secondsUnacknowledged(double now) const;

  // What a frame is to be.
  /// Returns whether a due frame may begin while `beingMade` others are in progress.
  [[nodiscard]] bool mayBegin(double now, int beingMade);
  /// One that is due waits for the server.
  void waitsForServer(double now);
  void begins(double now);
  [[nodiscard]] double framesPerSecond() const;
  /// Nobody looks: no frame begins until that ends.
  [[nodiscard]] bool isHidden() const;
  /// Gives the camera of this frame its size and angle; returns the border, percent.
  int aim(world::Camera& camera, std::uint32_t frame, double now);
  /// The number of the capture that this frame is, if it is one; once.
  [[nodiscard]] std::optional<std::uint32_t> takeCapture(std::uint32_t frame);

  // What becomes of its picture.
  struct Choice {
    const EncoderKind* kind;
    EncodeOrder order;
    double bytes;  ///< that it may take
  };
  /// Which encoder is to make it. One that failed is not chosen again.
  [[nodiscard]] const EncoderKind& kind() const;
  void failed(const EncoderKind& kind);
  /// `still`: the camera stands where it stood in the picture before; `same`: no pixel is another.
  [[nodiscard]] Choice choose(const EncoderKind& kind, const QuantiserRange& range, double pixels, bool still,
                              bool same, double now);
  void encoded(const Choice& choice, bool independent, double pixels, std::size_t bytes);
  /// What that took, seconds.
  void took(FrameTimes::Place place, double seconds);
  /// The page shows already what would be sent.
  void unchanged(std::uint32_t lastInput);
  /// `allowed`: bytes that it might have taken.
  void sent(std::uint32_t frame, std::uint32_t lastInput, std::size_t bytes, double allowed, double now);
  /// The socket has taken all of it at `now`; the thread that writes had come to it at `reached`.
  void written(std::uint32_t frame, double reached, double now);

  /// To be said now, if anything is; `visitors` are in the world.
  [[nodiscard]] std::optional<Status> takeStatus(double now, std::size_t visitors);
  /// The same of where frames spend their time.
  [[nodiscard]] std::optional<Times> takeTimes(double now);
  /// For reports: of all that it keeps.
  [[nodiscard]] Status status() const;

 private:
  /// What the visitor wants, of `scale` times his window's size.
  [[nodiscard]] StreamWish wish(double scale) const;
  [[nodiscard]] double bitsPerSecond() const;
  /// That the visitor lets the stream take.
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
  double moved_ = 0.0;  ///< the camera, last
  FrameTimes times_;
  int borderSteps_ = 0;
  QuantiserControl quantisers_;
  QuantiserRange range_;
  Quantiser newestQuantiser_ = 30.0;
  bool wantsIndependent_ = true;
  double independentMade_ = -1.0;  ///< when one was last asked for and made
  CaptureRequest capture_;
  std::uint32_t newestSent_ = 0;
  double unacknowledgedSince_ = 0.0;  ///< if there are any
  std::uint32_t lastInput_ = 0;       ///< that the page's picture obeys
  std::uint32_t lastInputReported_ = 0;
  double wordSince_ = 0.0;  ///< when anything was last sent
  Status reported_;
};

}  // namespace grove::stream
