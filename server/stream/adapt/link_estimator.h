#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>

#include "stream/adapt/window_min.h"

namespace grove::stream {

/// A page's report of a frame's arrival.
struct Arrival {
  double acknowledged = 0.0;            ///< when the report came, by the server's clock
  double held = 0.0;                    ///< seconds from the arrival to the report
  std::optional<double> pageSeconds{};  ///< arrival by the page's clock; none from older pages
  bool browserBusy = false;             ///< slow decoding may have delayed the arrival's time stamp
};

/// Estimates the rate of a visitor's line from acknowledgements of presented frames.
///
/// Delay controls the estimate, not loss, which TCP hides: a frame's latency minus the minimum of the last seconds is
/// the queue before the bottleneck (Brakmo, Peterson, "TCP Vegas", 1995). Below a bound the rate grows; above it the
/// rate falls below the recently delivered one, as in Google Congestion Control (Carlucci and others, "Analysis and
/// Design of the Google Congestion Control for WebRTC", 2016). That control's filter of delay gradients is not needed:
/// it guards against jitter of single packets, and a frame is many packets. An overdue frame counts like a queue, so
/// the estimate reacts to a broken line before acknowledgements come.
///
/// Not every delay is a queue: the schedulers of both machines delay frames, too. Three facts distinguish them:
/// - Frames behind a bottleneck arrive spaced by their transmission time; after a hiccup they arrive together.
/// - A frame that was acknowledged after T proves that the line carries its bytes in T.
/// - An application-limited stream (Cardwell and others, "BBR: Congestion-Based Congestion Control", 2016) makes no
///   queue unless the line has become slower than the stream, and then every frame is late.
///
/// Times are seconds of the server's clock, except pageSeconds. Not thread-safe.
class LinkEstimator {
 public:
  static constexpr double kMinBitsPerSecond = 150e3;
  static constexpr double kMaxBitsPerSecond = 200e6;

  /// `allowed`: bytes available to the frame; a stream that uses much less is application-limited.
  void sent(std::uint32_t frame, std::size_t bytes, double allowed, double now);
  /// The server has written this frame; the line causes all further delay. Returns how long the frame had waited, or
  /// nothing if it is not in flight.
  std::optional<double> handedOver(std::uint32_t frame, double now);
  /// This frame has arrived; earlier ones have arrived, too, or were dropped. Ignores numbers that are not in flight.
  void arrived(std::uint32_t frame, const Arrival& arrival);
  /// Checks for overdue frames. Call every few milliseconds.
  void look(double now);

  /// Returns whether one more frame, after `more` that are sent soon, would only wait before the bottleneck, at this
  /// wanted rate.
  [[nodiscard]] bool isFull(double now, double framesPerSecond, std::size_t more) const;
  [[nodiscard]] std::size_t framesUnderWay() const noexcept { return underWay_.size(); }

  /// The rate available to a stream.
  [[nodiscard]] double bitsPerSecond() const noexcept { return rate_; }
  /// Returns whether the line has limited that rate before.
  [[nodiscard]] bool isMeasured() const noexcept { return lastFall_.has_value(); }
  /// Of the idle line, seconds; 0 until it is known.
  [[nodiscard]] double roundTrip() const noexcept { return roundTrip_.value().value_or(0.0); }
  /// The newest frame's time in the queue before the bottleneck, seconds.
  [[nodiscard]] double queueing() const noexcept { return queueing_; }
  /// Returns whether the stream uses much less than it may, so that its delays say nothing about the line.
  [[nodiscard]] bool isApplicationLimited() const noexcept { return usedBytes_ < kApplicationLimit * allowedBytes_; }
  /// Assumes this rate until the line disproves it.
  void trust(double bitsPerSecond) { rate_ = std::clamp(bitsPerSecond, rate_, kMaxBitsPerSecond); }
  /// The rate that frames of the last second have proven, bits a second; 0 without any.
  [[nodiscard]] double proven() const;

 private:
  /// A stream that uses a smaller share of its rate is application-limited.
  static constexpr double kApplicationLimit = 0.7;
  struct Frame {
    std::uint32_t number;
    std::size_t bytes;
    double sent;
  };
  struct Delivery {
    double time;
    std::size_t bytes;
    double proven;   ///< lower bound of the line's rate, bits a second
    double carried;  ///< the line's rate if it caused all of the delay, bits a second
    bool isLate;     ///< probably because of the line
  };
  void take(const Frame& frame, const Arrival& arrival);
  void judge(double now, double bits, double sinceLast);
  void grow(double now);
  /// Falls towards the line's rate; returns false if the last fall is too recent.
  bool fall(double now, double carried);
  [[nodiscard]] double delivered(double now) const;
  /// The line's rate if every frame of the last second was late; else infinity.
  [[nodiscard]] double carriedWhenAllAreLate() const;
  /// Returns the seconds that `bytes` take through the bottleneck at the present rate.
  [[nodiscard]] double passage(std::size_t bytes) const;

  std::deque<Frame> underWay_;
  std::size_t bytesUnderWay_ = 0;
  std::deque<Delivery> deliveries_;  ///< of the last second
  double usedBytes_ = 0.0;           ///< by the newest frames
  double allowedBytes_ = 0.0;        ///< available to them
  WindowMin transit_;                ///< from sending to arrival; the two clocks need not agree
  WindowMin flight_;                 ///< from sending to acknowledgement
  WindowMin roundTrip_;              ///< the same, minus the time that the page held the frame
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
