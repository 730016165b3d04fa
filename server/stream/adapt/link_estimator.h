#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>

#include "stream/adapt/window_min.h"

namespace grove::stream {

/// What the page reports of a frame's arrival.
struct Arrival {
  double acknowledged = 0.0;            ///< when its word came, seconds of the server's clock
  double held = 0.0;                    ///< seconds between arrival and the page's word
  std::optional<double> pageSeconds{};  ///< when it arrived by the page's clock; none: of an older page
  bool browserBusy = false;             ///< decoding took so long that the browser may have noticed the arrival late
};

/// Estimates what a visitor's line carries, from acknowledgements of presented frames.
///
/// Delay leads it and not loss, which TCP hides: a frame's time under way, less the smallest of the last seconds, is
/// the queue before the bottleneck (Brakmo, Peterson, "TCP Vegas", 1995). Below a bound the rate grows, above it the
/// rate falls below what was delivered of late, as in Google Congestion Control (Carlucci and others, "Analysis and
/// Design of the Google Congestion Control for WebRTC", 2016), whose filter of delay gradients it does without: that
/// guards against jitter of single packets, and a frame is many. A frame that is overdue counts like a queue, so that
/// a line that breaks down is noticed before its acknowledgements come.
///
/// A delay is not always a queue: schedulers of both machines delay frames, too. Three facts tell them apart:
/// - Frames behind a bottleneck arrive as far apart as it takes to carry them; after a hiccup they arrive together.
/// - A frame that was there and acknowledged after T proves that the line carries its bytes in T.
/// - A stream that takes less than it may (limited by the application, as BBR calls it: Cardwell and others, "BBR:
///   Congestion-Based Congestion Control", 2016) makes no queue unless the line has become slower than the stream, and
///   then every frame is late.
///
/// Times are seconds of one clock of the server's, but for pageSeconds. One thread at a time.
class LinkEstimator {
 public:
  static constexpr double kMinBitsPerSecond = 150e3;
  static constexpr double kMaxBitsPerSecond = 200e6;

  /// `allowed`: bytes that the frame might have taken; a stream that takes much less is limited by the application.
  void sent(std::uint32_t frame, std::size_t bytes, double allowed, double now);
  /// The server has done its part for this frame: what delays it from now on is the line. Returns for how long it had
  /// been waiting; none if it is not under way.
  std::optional<double> handedOver(std::uint32_t frame, double now);
  /// This frame is there; those before it are too, or were dropped for it. Numbers that are not under way are ignored.
  void arrived(std::uint32_t frame, const Arrival& arrival);
  /// Nothing may have come for a while; call it every few milliseconds.
  void look(double now);

  /// Whether, with `more` frames that are to be sent soon, another would only wait before the bottleneck;
  /// `framesPerSecond` are wanted.
  [[nodiscard]] bool isFull(double now, double framesPerSecond, std::size_t more) const;
  [[nodiscard]] std::size_t framesUnderWay() const noexcept { return underWay_.size(); }

  /// That a stream may take.
  [[nodiscard]] double bitsPerSecond() const noexcept { return rate_; }
  /// Whether the line, and not what was sent, has set that.
  [[nodiscard]] bool isMeasured() const noexcept { return lastFall_.has_value(); }
  /// Of an idle line, seconds; 0 until it is known.
  [[nodiscard]] double roundTrip() const noexcept { return roundTrip_.value().value_or(0.0); }
  /// In the queue before the bottleneck, seconds; the newest frame's.
  [[nodiscard]] double queueing() const noexcept { return queueing_; }
  /// Whether the stream takes much less than it may, so that its delays show nothing of the line.
  [[nodiscard]] bool isApplicationLimited() const noexcept { return usedBytes_ < kApplicationLimit * allowedBytes_; }
  /// Takes the line for good enough for so much, until it shows the contrary.
  void trust(double bitsPerSecond) { rate_ = std::clamp(bitsPerSecond, rate_, kMaxBitsPerSecond); }
  /// What frames of the last second have proven that the line carries, bits a second; 0 if none came.
  [[nodiscard]] double proven() const;

 private:
  /// A stream that takes less than this of what it may is limited by the application.
  static constexpr double kApplicationLimit = 0.7;
  struct Frame {
    std::uint32_t number;
    std::size_t bytes;
    double sent;
  };
  struct Delivery {
    double time;
    std::size_t bytes;
    double proven;   ///< that the line carries at least, bits a second
    double carried;  ///< what it carries if all of the delay is the line's, bits a second
    bool isLate;     ///< because of the line, as far as can be known
  };
  void take(const Frame& frame, const Arrival& arrival);
  void judge(double now, double bits, double sinceLast);
  void grow(double now);
  /// Falls towards what the line carries; false if the last fall is too fresh.
  bool fall(double now, double carried);
  [[nodiscard]] double delivered(double now) const;
  /// What the line carries, if every frame of the last second was late; else infinity.
  [[nodiscard]] double carriedWhenAllAreLate() const;
  /// How long a frame of so many bytes takes through the bottleneck at the present rate.
  [[nodiscard]] double passage(std::size_t bytes) const;

  std::deque<Frame> underWay_;
  std::size_t bytesUnderWay_ = 0;
  std::deque<Delivery> deliveries_;  ///< of the last second
  double usedBytes_ = 0.0;           ///< by the newest frames,
  double allowedBytes_ = 0.0;        ///< of so many
  WindowMin transit_;                ///< from sending to arrival, by clocks that need not agree
  WindowMin flight_;                 ///< from sending to acknowledgement
  WindowMin roundTrip_;              ///< the same, less the time the page held it
  double usualFlight_ = 0.0;         ///< of the newest frames
  double queueing_ = 0.0;
  double lastArrival_ = 0.0;  ///< by the page's clock, or as it is estimated without
  double rate_ = 3e6;
  double lastGrowth_ = 0.0;
  std::optional<double> lastFall_;
  bool wasLong_ = false;  ///< the queue, with the newest frame
  int overdueFalls_ = 0;  ///< since a frame arrived
};

}  // namespace grove::stream
