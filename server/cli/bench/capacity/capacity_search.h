#pragma once

#include <functional>
#include <optional>

namespace grove::cli {

/// Runs one trial and returns whether the machine serves `visitors`; nothing if the search was stopped.
using ServesTrial = std::function<std::optional<bool>(int visitors)>;

/// Returns the largest number of visitors, at most `max`, that the machine serves; nothing if the search was stopped.
/// Doubles, then bisects. Trials are noisy, so two of three trials decide at the result and at the number above it.
[[nodiscard]] std::optional<int> findCapacity(const ServesTrial& serves, int max);

}  // namespace grove::cli
