#include "node/transport/link_gauge.h"

#include <algorithm>

namespace grove::node {
namespace {

double secondsOf(LinkGauge::Clock::duration duration) { return std::chrono::duration<double>(duration).count(); }

}  // namespace

void LinkGauge::read(Clock::time_point now, const LinkTraffic& traffic, Clock::duration roundTrip) {
  readings_.push_back({now, traffic, roundTrip});
  if (readings_.size() > kKept) readings_.pop_front();
}

LinkPace LinkGauge::pace() const {
  if (readings_.empty()) return {};
  LinkPace pace{.roundTrip = secondsOf(std::ranges::min_element(readings_, {}, &Reading::roundTrip)->roundTrip)};
  const double seconds = secondsOf(readings_.back().at - readings_.front().at);
  if (seconds <= 0.0) return pace;
  const LinkTraffic travelled = readings_.back().traffic - readings_.front().traffic;
  pace.sent = static_cast<double>(travelled.toBackend) / seconds;
  pace.received = static_cast<double>(travelled.toFrontend()) / seconds;
  return pace;
}

}  // namespace grove::node
