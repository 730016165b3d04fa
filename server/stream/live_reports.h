#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "stream/host.h"

namespace grove::stream {

/// What the server tells of itself at this path, as JSON made for this request: /statistics.json, or /trace.json, the
/// newest stage runs as a Chrome trace. Nothing if the path is another one.
[[nodiscard]] std::optional<std::string> liveReport(const Host& host, std::string_view path);

}  // namespace grove::stream
