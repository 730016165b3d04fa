#pragma once

#include <string>

namespace grove::measure {

/// Returns the processor's name as the system reports it; empty if it reports none.
[[nodiscard]] std::string processorName();

/// Returns the processor's name and the number of cores, as a caption of measurements.
[[nodiscard]] std::string machineName();

}  // namespace grove::measure
