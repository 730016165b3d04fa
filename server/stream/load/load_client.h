#pragma once

#include "stream/load/load_plan.h"
#include "stream/load/load_report.h"
#include "stream/load/load_target.h"

namespace grove::stream {

/// Runs the plan's sessions as real websocket clients on the calling thread, until all admitted ones have been measured
/// for the plan's seconds. Sessions that are refused or disconnected are errors in the outcome.
[[nodiscard]] LoadOutcome runLoadClients(const LoadTarget& target, const LoadPlan& plan);

}  // namespace grove::stream
