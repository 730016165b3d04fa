#pragma once

#include <string>

namespace grove::measure {

/// The processor's name as the system gives it; empty if it gives none.
[[nodiscard]] std::string processorName();

}  // namespace grove::measure
