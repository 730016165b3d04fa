#pragma once

#include <cstddef>
#include <functional>
#include <optional>

#include "pipeline/executor.h"

namespace grove::pipeline {

/// Returns the number of the next part, or nothing if all parts are taken.
using NextPart = std::function<std::optional<std::size_t>()>;

/// Shares out parts 0 to `parts` - 1: calls `work` on this thread and on those of `helpers` that have time before all
/// parts are done; each takes part after part from `next`. Waits for no task that has not begun, so it may be called on
/// one of the helpers' threads. After an exception no part is begun; the exception is rethrown here.
void shareOut(Executor& helpers, std::size_t parts, const std::function<void(const NextPart& next)>& work);

}  // namespace grove::pipeline
