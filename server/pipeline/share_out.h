#pragma once

#include <cstddef>
#include <functional>
#include <optional>

#include "pipeline/executor.h"

namespace grove::pipeline {

/// The number of the next part that nobody does yet; nothing if there is none.
using NextPart = std::function<std::optional<std::size_t>()>;

/// Shares out parts 0 to `parts` - 1: calls `work` on this thread and on those of `helpers` that have time before all
/// is done, and each takes one part after the other from `next`. Waits for no task that has not begun, so it may be
/// called on one of the helpers' threads. The first exception ends it after the parts that have begun, and is rethrown
/// here.
void shareOut(Executor& helpers, std::size_t parts, const std::function<void(const NextPart& next)>& work);

}  // namespace grove::pipeline
