#pragma once

#include <string_view>

#include "node/messages/result.h"
#include "pipeline/timeline.h"

namespace grove::node {

/// Packs a result for a link that carries bytes, see BackendEnd::compress(): its payload becomes `packed`. Throws
/// PackingError. Any thread.
void packResult(Result& result, pipeline::Timeline& timeline, std::string_view subject);

}  // namespace grove::node
