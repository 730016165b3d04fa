#pragma once

#include "stream/load/load_plan.h"
#include "stream/load/load_report.h"
#include "stream/load/load_target.h"

namespace grove::stream {

/// Runs the plan's sessions as real websocket clients on the calling thread until all that are let in have been counted
/// for its seconds. Those that are not let in or are thrown out are errors in the outcome.
[[nodiscard]] LoadOutcome runLoadClients(const LoadTarget& target, const LoadPlan& plan);

}  // namespace grove::stream
