#include "stream/load/link/congestion_window.h"

#include <algorithm>
#include <cmath>

namespace grove::stream {
namespace {

constexpr std::size_t kInitialSegments = 10;  // RFC 6928
constexpr double kMinSegments = 2.0;
// RFC 9438, 4.1 and 4.6; the growth is of section 4.3.
constexpr double kScaling = 0.4;
constexpr double kReduction = 0.7;
constexpr double kRenoGrowth = 3.0 * (1.0 - kReduction) / (1.0 + kReduction);

}  // namespace

CongestionWindow::CongestionWindow(LinkTime roundTrip) : roundTrip_(roundTrip), mostInFlight_(kInitialSegments) {}

LinkTime CongestionWindow::opens(LinkTime time) {
  acknowledge(time);
  const bool isFull = static_cast<double>(inFlight_.size()) + 1.0 > segments(time);
  return isFull && !inFlight_.empty() ? inFlight_.front() + roundTrip_ : time;
}

void CongestionWindow::sent(LinkTime leaves) {
  acknowledge(leaves);
  inFlight_.push_back(leaves);
  mostInFlight_ = std::max(mostInFlight_, inFlight_.size());
}

void CongestionWindow::lost(LinkTime left, LinkTime noticed) {
  if (left <= reduced_) return;
  atLoss_ = std::min(segments(noticed), static_cast<double>(mostInFlight_));
  reduced_ = noticed;
}

double CongestionWindow::segments(LinkTime time) const {
  if (std::isinf(atLoss_)) return atLoss_;
  const double since = std::chrono::duration<double>(std::max(time - reduced_, LinkTime{0})).count();
  const double back = std::cbrt(atLoss_ * (1.0 - kReduction) / kScaling);
  const double cubic = kScaling * std::pow(since - back, 3.0) + atLoss_;
  const double roundTrips = since / std::max(std::chrono::duration<double>(roundTrip_).count(), 1e-6);
  const double reno = kReduction * atLoss_ + kRenoGrowth * roundTrips;
  return std::max({cubic, reno, kMinSegments});
}

void CongestionWindow::acknowledge(LinkTime time) {
  while (!inFlight_.empty() && inFlight_.front() + roundTrip_ <= time) inFlight_.pop_front();
}

}  // namespace grove::stream
