#pragma once

#include <map>
#include <string>

#include "measure/amortization.h"

namespace grove::cli {

/// Divides the cost of a visitor's frame, in milliseconds of CPU: by type of object for the work of both nodes; "JPEG"
/// is the encoder, and every other stage has its name. The parts add up to measure::FrameCost::perUser() of all.
[[nodiscard]] std::map<std::string, double> layersOf(const measure::Reading& before, const measure::Reading& after,
                                                     const measure::Served& served);

}  // namespace grove::cli
