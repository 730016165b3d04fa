#pragma once

#include <nlohmann/json_fwd.hpp>

#include "pipeline/reuse.h"

namespace grove::stream {

/// The form of `/statistics.json` and of `grove bench amortize --json`.
[[nodiscard]] nlohmann::ordered_json reuseJson(const pipeline::Reuse& reuse);

}  // namespace grove::stream
