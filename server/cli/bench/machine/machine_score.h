#pragma once

#include <string>
#include <vector>

#include "cli/bench/machine/machine_kernels.h"

namespace grove::cli {

/// Median CPU time of a kernel, in milliseconds.
struct KernelTime {
  std::string name;
  double referenceMilliseconds = 0.0;
  double hot = 0.0;   ///< runs right after each other
  double cold = 0.0;  ///< runs between which other memory has passed through all caches
};

/// The speed of one core with Grove's work: 100 is the reference core, 200 takes half the time. Geometric means, so
/// every kernel counts alike. Times the score is work in units that do not depend on the processor (section 3.1 wants
/// units of computation).
struct MachineScore {
  double hot = 0.0;
  double cold = 0.0;
  double all = 0.0;  ///< geometric mean of both
};

/// Measures on the calling thread: at most `runs` times each, hot and cold, and no longer than two seconds each.
[[nodiscard]] std::vector<KernelTime> timesOf(const std::vector<MachineKernel>& kernels, int runs);

[[nodiscard]] MachineScore scoreOf(const std::vector<KernelTime>& times);

}  // namespace grove::cli
