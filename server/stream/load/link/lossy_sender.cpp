#include "stream/load/link/lossy_sender.h"

#include <algorithm>

namespace grove::stream {

LossySender::LossySender(double share, std::uint64_t seed, LinkTime roundTrip, LinkTime jitter)
    : roundTrip_(roundTrip), losses_(share, seed), recovery_(roundTrip, jitter), window_(roundTrip) {}

LinkTime LossySender::mayLeave(LinkTime time) {
  for (;;) {
    advance(time);
    const LinkTime opens = window_.opens(time);
    if (opens <= time) return time;
    time = opens;
  }
}

const std::vector<TcpRecovery::Arrival>& LossySender::sent(LinkTime leaves, LinkTime arrives) {
  advance(leaves);
  window_.sent(leaves);
  return recovery_.sent({next_++, leaves, arrives, losses_.next()});
}

double LossySender::rateAt(LinkTime time) const {
  const double seconds = std::max(std::chrono::duration<double>(roundTrip_).count(), 1e-6);
  return window_.segments(time) * 8.0 * static_cast<double>(kSegmentBytes) / seconds;
}

void LossySender::advance(LinkTime time) {
  recovery_.advance(time, [this](LinkTime left, LinkTime noticed) { window_.lost(left, noticed); });
}

}  // namespace grove::stream
