#pragma once

#include <vector>

#include "stream/load/link/link_profile.h"

namespace grove::stream {

/// Computes when bits leave one end of a link whose rate changes with time and which stalls periodically. Immutable.
class LinkSchedule {
 public:
  /// As in LinkProfile.
  LinkSchedule(std::vector<RateStep> rates, LinkTime stall, LinkTime stallEvery);

  /// Returns when the last of `bits` has left, if the first can leave from `start` on.
  [[nodiscard]] LinkTime finish(LinkTime start, double bits) const;

  [[nodiscard]] double rateAt(LinkTime time) const;
  [[nodiscard]] double maxRate() const;

 private:
  [[nodiscard]] std::vector<RateStep>::const_iterator stepAt(LinkTime time) const;
  /// Returns `time`, or the end of the stall at that time.
  [[nodiscard]] LinkTime moving(LinkTime time) const;
  [[nodiscard]] LinkTime nextStall(LinkTime moving) const;

  std::vector<RateStep> rates_;
  LinkTime stall_;
  LinkTime stallEvery_;
};

}  // namespace grove::stream
