#pragma once

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
/// Times are seconds of one clock of the server's, but for pageSeconds. One thread at a time.
class LinkEstimator {
 public:
  static constexpr double kMinBitsPerSecond = 150e3;
  static constexpr double kMaxBitsPerSecond = 40e6;

  void sent(std::uint32_t frame, std::size_t bytes, double now);
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

 private:
  struct Frame {
    std::uint32_t number;
    std::size_t bytes;
    double sent;
  };
  struct Delivery {
    double time;
    std::size_t bytes;
  };
  void grow(double now);
  /// False if the last one is too fresh.
  bool fall(double now);
  [[nodiscard]] double delivered(double now) const;
  /// How long a frame of so many bytes takes through the bottleneck at the present rate.
  [[nodiscard]] double passage(std::size_t bytes) const;

  std::deque<Frame> underWay_;
  std::size_t bytesUnderWay_ = 0;
  std::deque<Delivery> deliveries_;  ///< of the last kDeliverySeconds
  WindowMin transit_;                ///< from sending to arrival, by clocks that need not agree
  WindowMin flight_;                 ///< from sending to acknowledgement
  WindowMin roundTrip_;              ///< the same, less the time the page held it
  double usualFlight_ = 0.0;         ///< of the newest frames
  double queueing_ = 0.0;
  double rate_ = 3e6;
  double lastGrowth_ = 0.0;
  std::optional<double> lastFall_;
  bool wasLong_ = false;  ///< the queue, with the newest frame
  int overdueFalls_ = 0;  ///< since a frame arrived
};

}  // namespace grove::stream
