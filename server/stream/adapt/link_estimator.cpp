#include "stream/adapt/link_estimator.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace grove::stream {
namespace {

constexpr double kBitsPerByte = 8.0;
/// Queues, beside a frame's own passage, that let the rate grow, and that make it fall.
constexpr double kShortQueue = 0.012;
constexpr double kLongQueue = 0.035;
/// A queue lasts; one that is gone with the next frame was somebody's scheduler. Not so one as long as this.
constexpr double kCertainQueue = 0.080;
/// So long after it should have come, a frame is overdue.
constexpr double kOverdue = 0.080;
constexpr int kMaxOverdueFalls = 2;
constexpr double kDeliverySeconds = 0.4;
/// What frames have shown counts for so long.
constexpr double kEvidenceSeconds = 1.0;
/// Of these, so many and over so long a time must be late before a stream that is limited by the application falls.
constexpr std::size_t kMinLate = 3;
constexpr double kMinLateSeconds = 0.5;
constexpr double kUseDecay = 0.8;
/// Frames that arrive this much faster than the estimate, one after the other, were not delayed by the line.
constexpr double kBunched = 1.5;
/// Of what was proven; the rest is for lines that carry a burst faster than what follows.
constexpr double kOfProven = 0.8;
constexpr double kMinServiceSeconds = 0.001;
constexpr double kMinSecondsBetweenFalls = 0.15;
/// A fall goes to this much of what was delivered, but neither further nor less than this of what the rate was.
constexpr double kOfDelivered = 0.85;
constexpr double kDeepestFall = 0.4;
constexpr double kSmallestFall = 0.95;
/// Growth a second before the line was ever full, and at most after that.
constexpr double kFirstGrowth = 6.0;
constexpr double kMaxGrowth = 1.6;
/// After a fall the rate goes back up to about what the line carried, stays near that, and tries ever more then: as
/// CUBIC's window does (RFC 9438), of which this is the slope.
constexpr double kBackSeconds = 1.2;
constexpr double kCurvature = 0.35;
/// What has not been tried is not known: the rate stays within this of what is delivered.
constexpr double kBeyondDelivered = 2.0;
constexpr double kBeyondAtMin = 400e3;
constexpr std::size_t kMinWindow = 2;
constexpr std::size_t kMaxWindow = 24;
/// More than the idle line's flight may be under way by this; it covers jitter, not queues.
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
  // By the page's clock, so that the way back does not count; but that clock may jump, run fast or lie, and no frame
  // has waited for longer than it took until its acknowledgement.
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
  // Nothing more is sent by now; how far it has to fall is seen when something arrives.
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
  // What has been changed shows a round trip later.
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
