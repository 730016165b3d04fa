#include "stream/load/link/link_schedule.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace grove::stream {

LinkSchedule::LinkSchedule(std::vector<RateStep> rates, LinkTime stall, LinkTime stallEvery)
    : rates_(std::move(rates)), stall_(stall), stallEvery_(stallEvery) {
  assert(!rates_.empty() && rates_.front().from.count() == 0 && (stallEvery.count() == 0 || stall < stallEvery));
}

LinkTime LinkSchedule::finish(LinkTime start, double bits) const {
  LinkTime now = start;
  for (;;) {
    now = moving(now);
    const auto step = stepAt(now);
    const auto next = std::next(step);
    const LinkTime until = std::min(nextStall(now), next == rates_.end() ? LinkTime::max() : next->from);
    const double nanoseconds = std::ceil(bits / step->bitsPerSecond * 1e9);
    if (nanoseconds <= static_cast<double>((until - now).count())) {
      return now + LinkTime{static_cast<LinkTime::rep>(nanoseconds)};
    }
    bits -= static_cast<double>((until - now).count()) * 1e-9 * step->bitsPerSecond;
    now = until;
  }
}

double LinkSchedule::rateAt(LinkTime time) const { return stepAt(time)->bitsPerSecond; }

double LinkSchedule::maxRate() const { return std::ranges::max(rates_, {}, &RateStep::bitsPerSecond).bitsPerSecond; }

std::vector<RateStep>::const_iterator LinkSchedule::stepAt(LinkTime time) const {
  return std::prev(std::ranges::upper_bound(rates_, time, {}, &RateStep::from));
}

LinkTime LinkSchedule::moving(LinkTime time) const {
  if (stallEvery_.count() == 0) return time;
  const LinkTime phase = time % stallEvery_;
  return phase < stallEvery_ - stall_ ? time : time + (stallEvery_ - phase);
}

LinkTime LinkSchedule::nextStall(LinkTime moving) const {
  if (stallEvery_.count() == 0) return LinkTime::max();
  return moving + (stallEvery_ - stall_ - moving % stallEvery_);
}

}  // namespace grove::stream
