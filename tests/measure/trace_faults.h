#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace grove::measure {

/// What is wrong with a document of chromeTrace(), or nothing: slices of a thread that overlap in part, flow events
/// without a slice around them, flows that do not start once, finish once and go forward in time.
[[nodiscard]] std::string traceFault(const nlohmann::json& document);

}  // namespace grove::measure
