#pragma once

#include <string>

#include "pipeline/timeline.h"

namespace grove::stream {

/// What `/statistics.json` answers: since the start, for each stage its work (across-user, per-user-backend or
/// per-user-frontend), runs, failures and milliseconds of CPU and wall time, and the named counters.
[[nodiscard]] std::string statisticsJson(const pipeline::Timeline& timeline, std::size_t visitors);

}  // namespace grove::stream
