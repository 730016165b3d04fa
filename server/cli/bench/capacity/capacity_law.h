#pragma once

#include <optional>
#include <vector>

#include "cli/bench/capacity/capacity_trial.h"

namespace grove::cli {

/// The paper's law M = N (1 - alpha) + alpha (section 3.1), with alpha from the CPU of the servers. N and M are whole
/// numbers of visitors, so the law gives a range: a machine that serves N and not N + 1 has a capacity from N to N + 1.
struct CapacityLaw {
  double alpha = 0.0;       ///< across-user share of the cost of a single visitor
  double privateMin = 0.0;  ///< private visitors for the shared capacity
  double privateMax = 0.0;  ///< for one visitor more
  /// Whether a machine that serves `measured` private visitors, and not one more, can obey the law.
  [[nodiscard]] bool agrees(int measured) const { return privateMax >= measured && privateMin <= measured + 1; }
};

/// Computes the law from the trials with `shared` visitors and with one, both in one world; nothing if `shared` is less
/// than two.
[[nodiscard]] std::optional<CapacityLaw> capacityLaw(const std::vector<CapacityTrial>& trials, int shared);

}  // namespace grove::cli
