#include "stream/adapt/link_estimator.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace grove::stream {
namespace {

constexpr double kBitsPerByte = 8.0;
/// Queue delays, without a frame's own transmission time, below which the rate grows and above which it falls.
constexpr double kShortQueue = 0.012;
constexpr double kLongQueue = 0.035;
/// A queue persists; a delay that is gone with the next frame was caused by a scheduler, unless it is this long.
constexpr double kCertainQueue = 0.080;
/// A frame is overdue this long after its expected arrival.
constexpr double kOverdue = 0.080;
constexpr int kMaxOverdueFalls = 2;
constexpr double kDeliverySeconds = 0.4;
/// Evidence from frames expires after this.
constexpr double kEvidenceSeconds = 1.0;
/// Minimum number and time span of late frames before an application-limited stream's rate falls.
constexpr std::size_t kMinLate = 3;
constexpr double kMinLateSeconds = 0.5;
constexpr double kUseDecay = 0.8;
/// Consecutive frames that arrive this much faster than the estimate were not delayed by the line.
constexpr double kBunched = 1.5;
/// Share of the proven rate; the rest is for lines that carry a burst faster than what follows.
constexpr double kOfProven = 0.8;
constexpr double kMinServiceSeconds = 0.001;
constexpr double kMinSecondsBetweenFalls = 0.15;
/// A fall goes to this share of the delivered rate, within these shares of the previous rate.
constexpr double kOfDelivered = 0.85;
constexpr double kDeepestFall = 0.4;
constexpr double kSmallestFall = 0.95;
/// Growth per second before the line was ever full, and the maximum after that.
constexpr double kFirstGrowth = 6.0;
constexpr double kMaxGrowth = 1.6;
/// After a fall the rate returns to about the line's last rate, stays near it, and then grows ever faster, as CUBIC's
/// window does (RFC 9438); this is its slope.
constexpr double kBackSeconds = 1.2;
constexpr double kCurvature = 0.35;
/// An untried rate is unknown: the rate stays within this multiple of the delivered rate.
constexpr double kBeyondDelivered = 2.0;
constexpr double kBeyondAtMin = 400e3;
constexpr std::size_t kMinWindow = 2;
constexpr std::size_t kMaxWindow = 24;
/// Data in flight may exceed what the idle line's round trip needs by this; it covers jitter, not queues.
constexpr double kSlackSeconds = 0.040;
constexpr double kBytesSlackSeconds = 0.080;

}  // namespace

double LinkEstimator::passage(std::size_t bytes) const { return kBitsPerByte * static_cast<double>(bytes) / rate_; }

void LinkEstimator::sent(std::uint32_t frame, std::size_t bytes, double allowed, double now) {
  underWay_.push_back({frame, bytes, now});
  bytesUnderWay_ += bytes;
  usedBytes_ = kUseDecay * usedBytes_ + static_cast<double>(bytes);
  allowedBytes_ = kUseDecay * allowedBytes_ + std::max(allowed, static_cast<double>(bytes));
}

std::optional<double> LinkEstimator::handedOver(std::uint32_t frame, double now) {
  const auto found = std::ranges::find(underWay_, frame, &Frame::number);
  if (found == underWay_.end()) return std::nullopt;
  const double waited = std::max(0.0, now - found->sent);
  found->sent += waited;
  return waited;
}

void LinkEstimator::arrived(std::uint32_t frame, const Arrival& arrival) {
  const double now = arrival.acknowledged;
  while (!deliveries_.empty() && deliveries_.front().time < now - kEvidenceSeconds) deliveries_.pop_front();
  std::optional<Frame> newest;
  while (!underWay_.empty() && underWay_.front().number <= frame) {
    newest = underWay_.front();
    underWay_.pop_front();
    bytesUnderWay_ -= newest->bytes;
    if (newest->number < frame) deliveries_.push_back({now, newest->bytes, 0.0, 0.0, true});
  }
  if (newest && newest->number == frame) take(*newest, arrival);
}

void LinkEstimator::take(const Frame& frame, const Arrival& arrival) {
  const double now = arrival.acknowledged;
  overdueFalls_ = 0;
  const double flight = now - frame.sent;
  const double held = std::clamp(arrival.held, 0.0, flight);
  const double transit = arrival.pageSeconds ? *arrival.pageSeconds - frame.sent : flight - held;
  flight_.add(now, flight);
  roundTrip_.add(now, flight - held);
  transit_.add(now, transit);
  usualFlight_ += (flight - usualFlight_) / 8.0;
  // By the page's clock, which excludes the way back. But that clock may jump, run fast or be forged, and no frame has
  // waited longer than until its acknowledgement.
  queueing_ = std::min(transit - *transit_.value(), flight - *flight_.value());

  const double bits = kBitsPerByte * static_cast<double>(frame.bytes);
  const double arrived = frame.sent + transit;
  const double sinceLast = arrived - std::exchange(lastArrival_, arrived);
  const bool isLong = queueing_ > kLongQueue + passage(frame.bytes);
  deliveries_.push_back({.time = now,
                         .bytes = frame.bytes,
                         .proven = bits / std::max(kMinServiceSeconds, arrival.pageSeconds ? flight - held : flight),
                         .carried = bits / std::max(kMinServiceSeconds, queueing_),
                         .isLate = isLong && !arrival.browserBusy});
  judge(now, bits, sinceLast);
}

void LinkEstimator::judge(double now, double bits, double sinceLast) {
  const double own = bits / rate_;
  const bool isBunched = bits > kBunched * rate_ * std::max(0.0, sinceLast);
  const bool isLong = queueing_ > kLongQueue + own && !isBunched;
  if (isApplicationLimited()) {
    if (isLong) fall(now, carriedWhenAllAreLate());
  } else if (isLong && (wasLong_ || queueing_ > kCertainQueue + own)) {
    fall(now, delivered(now));
  }
  wasLong_ = isLong;
  if (queueing_ < kShortQueue + own) grow(now);
}

void LinkEstimator::look(double now) {
  if (underWay_.empty() || !flight_.value() || isApplicationLimited()) return;
  const Frame& oldest = underWay_.front();
  const double due = *flight_.value() + kLongQueue + kOverdue + passage(bytesUnderWay_);
  // Nothing more is being sent; the next arrival shows how far the rate must fall.
  if (now - oldest.sent > due && overdueFalls_ < kMaxOverdueFalls && fall(now, delivered(now))) ++overdueFalls_;
}

bool LinkEstimator::isFull(double now, double framesPerSecond, std::size_t more) const {
  if (underWay_.size() + more < kMinWindow) return false;
  const double idle = flight_.value().value_or(0.0);
  const double flight = std::min(std::max(idle, usualFlight_), idle + kSlackSeconds);
  const auto window = static_cast<std::size_t>(std::ceil(flight * framesPerSecond)) + 1;
  if (underWay_.size() + more >= std::clamp(window, kMinWindow, kMaxWindow)) return true;
  if (static_cast<double>(bytesUnderWay_) * kBitsPerByte > rate_ * (idle + kBytesSlackSeconds)) return true;
  return !underWay_.empty() && now - underWay_.front().sent > idle + kLongQueue + kOverdue;
}

double LinkEstimator::delivered(double now) const {
  double bytes = 0.0;
  for (const Delivery& each : deliveries_) {
    if (each.time > now - kDeliverySeconds) bytes += static_cast<double>(each.bytes);
  }
  return bytes * kBitsPerByte / kDeliverySeconds;
}

double LinkEstimator::proven() const {
  double most = 0.0;
  for (const Delivery& each : deliveries_) most = std::max(most, each.proven);
  return most;
}

double LinkEstimator::carriedWhenAllAreLate() const {
  constexpr double kUnknown = std::numeric_limits<double>::infinity();
  if (deliveries_.size() < kMinLate || deliveries_.back().time - deliveries_.front().time < kMinLateSeconds) {
    return kUnknown;
  }
  double carried = 0.0;
  for (const Delivery& each : deliveries_) {
    if (!each.isLate) return kUnknown;
    carried = std::max(carried, each.carried);
  }
  return carried;
}

void LinkEstimator::grow(double now) {
  const double seconds = std::min(0.1, now - std::exchange(lastGrowth_, now));
  rate_ = std::clamp(kOfProven * proven(), rate_, kMaxBitsPerSecond);
  const double bound = kBeyondDelivered * delivered(now) + kBeyondAtMin;
  if (rate_ > bound) return;
  const double perSecond =
      lastFall_ ? std::min(kMaxGrowth, kCurvature * std::pow(now - *lastFall_ - kBackSeconds, 2.0)) : kFirstGrowth;
  rate_ = std::min({rate_ * std::exp(perSecond * seconds), std::max(bound, rate_), kMaxBitsPerSecond});
}

bool LinkEstimator::fall(double now, double carried) {
  // A change takes effect one round trip later.
  const double pause = std::max(kMinSecondsBetweenFalls, std::min(roundTrip() + queueing_, 1.0));
  if (kOfDelivered * carried >= rate_ || (lastFall_ && now - *lastFall_ < pause)) return false;
  const double wanted = std::clamp(kOfDelivered * carried, kDeepestFall * rate_, kSmallestFall * rate_);
  const double fallen = std::max({kMinBitsPerSecond, wanted, kOfProven * proven()});
  if (fallen >= rate_) return false;
  lastFall_ = now;
  rate_ = fallen;
  return true;
}

}  // namespace grove::stream
