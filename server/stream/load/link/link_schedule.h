#pragma once

#include <vector>

#include "stream/load/link/link_profile.h"

namespace grove::stream {

/// When bits have left one end of a link, whose rate changes with time and which stands still now and then. Immutable.
class LinkSchedule {
 public:
  /// As in LinkProfile.
  LinkSchedule(std::vector<RateStep> rates, LinkTime stall, LinkTime stallEvery);

  /// When the last of so many bits has left, if the first can from `start` on.
  [[nodiscard]] LinkTime finish(LinkTime start, double bits) const;

  [[nodiscard]] double rateAt(LinkTime time) const;
  [[nodiscard]] double maxRate() const;

 private:
  [[nodiscard]] std::vector<RateStep>::const_iterator stepAt(LinkTime time) const;
  /// The next time at which it moves, which is now or the end of a stall.
  [[nodiscard]] LinkTime moving(LinkTime time) const;
  [[nodiscard]] LinkTime nextStall(LinkTime moving) const;

  std::vector<RateStep> rates_;
  LinkTime stall_;
  LinkTime stallEvery_;
};

}  // namespace grove::stream
