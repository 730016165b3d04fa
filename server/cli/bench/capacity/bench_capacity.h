#pragma once

#include "cli/bench/capacity/capacity_trial.h"

namespace grove::cli {

/// `grove bench amortize --capacity`: finds by trials how many visitors this machine serves, first with one server for
/// all, then with one server per visitor, and compares both with the paper's law (section 3.1). Prints a table, or one
/// JSON document. Returns the process's exit code. Throws EnvironmentError or world::SceneError.
int runBenchCapacity(const CapacityPlan& plan, bool json);

}  // namespace grove::cli
