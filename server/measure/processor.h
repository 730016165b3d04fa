#pragma once

#include <string>

namespace grove::measure {

/// Returns the processor's name as the system reports it; empty if it reports none.
[[nodiscard]] std::string processorName();

}  // namespace grove::measure
