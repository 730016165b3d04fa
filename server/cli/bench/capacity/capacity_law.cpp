#include "cli/bench/capacity/capacity_law.h"

#include <algorithm>

#include "measure/amortization.h"

namespace grove::cli {
namespace {

/// Returns the CPU of one frame of all visitors: the mean CPU per frame of the trials in which `visitors` were served
/// in one world, times the visitors.
double costOfAll(const std::vector<CapacityTrial>& trials, int visitors) {
  double sum = 0.0;
  int count = 0;
  for (const CapacityTrial& trial : trials) {
    if (trial.privateWorlds || trial.visitors != visitors || trial.load.frames == 0) continue;
    sum += trial.cpuMillisecondsPerFrame() * visitors;
    ++count;
  }
  return count == 0 ? 0.0 : sum / count;
}

}  // namespace

std::optional<CapacityLaw> capacityLaw(const std::vector<CapacityTrial>& trials, int shared) {
  const double one = costOfAll(trials, 1);
  if (shared < 2 || one <= 0.0) return std::nullopt;
  const double perUser = (costOfAll(trials, shared) - one) / (shared - 1);
  CapacityLaw law;
  law.alpha = std::clamp(1.0 - perUser / one, 0.0, 1.0);
  law.privateMin = measure::privateVisitors(shared, law.alpha);
  law.privateMax = measure::privateVisitors(shared + 1, law.alpha);
  return law;
}

}  // namespace grove::cli
