#include "stream/load/link/tcp_recovery.h"

#include <algorithm>

namespace grove::stream {
namespace {

constexpr LinkTime kMinProbe = std::chrono::milliseconds(10);
constexpr LinkTime kMinVariation = std::chrono::milliseconds(200);
constexpr int kDuplicatesThreshold = 3;

}  // namespace

// Of the sum of two even distributions, the mean deviation (RTTVAR) is a third of their width.
TcpRecovery::TcpRecovery(LinkTime roundTrip, LinkTime jitter)
    : reordering_(roundTrip / 4),
      roundTrip_(roundTrip + jitter),
      probe_(std::max(2 * roundTrip_, kMinProbe)),
      timeout_(roundTrip_ + std::max(kMinVariation, 4 * jitter / 3)) {}

void TcpRecovery::advance(LinkTime now, const Noticed& noticed) {
  std::erase_if(gaps_, [&](Gap& gap) {
    while (gap.resends <= now) {
      noticed(gap.segment.leaves, gap.resends);
      if (gap.moreLost == 0) return true;
      resend(gap);
    }
    return false;
  });
}

const std::vector<TcpRecovery::Arrival>& TcpRecovery::sent(const Segment& segment) {
  changed_.clear();
  for (Gap& gap : gaps_) {
    if (follow(gap, segment)) changed_.push_back({gap.segment.number, arrivalOf(gap)});
  }
  if (segment.timesLost > 0) {
    openGap(segment);
    changed_.push_back({segment.number, arrivalOf(gaps_.back())});
  } else {
    lastAcknowledged_ = segment.arrives + roundTrip_ / 2;
  }
  return changed_;
}

void TcpRecovery::openGap(const Segment& segment) {
  const bool isAlone = gaps_.empty();
  const LinkTime wait = std::min(isAlone ? probe_ + kMinVariation : probe_, timeout_);
  gaps_.push_back(
      {segment, segment.leaves, std::max(segment.leaves, lastAcknowledged_) + wait, timeout_, segment.timesLost - 1});
}

bool TcpRecovery::follow(Gap& gap, const Segment& later) const {
  if (later.timesLost == 0) {
    const LinkTime acknowledged = later.arrives + roundTrip_ / 2;
    ++gap.later;
    if (gap.later == 1) {
      const LinkTime due = gap.sent + roundTrip_ + (gap.isRepeated ? LinkTime{0} : reordering_);
      gap.resends = std::max(acknowledged, due);
    } else if (gap.later == kDuplicatesThreshold) {
      gap.resends = std::min(gap.resends, acknowledged);
    } else {
      return false;
    }
    return true;
  }
  if (gap.later > 0 || gap.isRepeated) return false;
  gap.resends = std::max(later.leaves, lastAcknowledged_) + std::min(probe_, timeout_) + roundTrip_;
  return true;
}

void TcpRecovery::resend(Gap& gap) {
  if (gap.isRepeated && gap.later == 0) gap.timeout *= 2;
  gap.isRepeated = true;
  gap.later = 0;
  gap.sent = gap.resends;
  gap.resends = gap.sent + gap.timeout;
  --gap.moreLost;
}

LinkTime TcpRecovery::arrivalOf(Gap gap) {
  while (gap.moreLost > 0) resend(gap);
  return gap.resends + (gap.segment.arrives - gap.segment.leaves);
}

}  // namespace grove::stream
