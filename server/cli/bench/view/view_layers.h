#pragma once

#include <map>
#include <string>

#include "measure/amortization.h"

namespace grove::cli {

/// What a visitor's frame costs, divided among what it is made of, in milliseconds of CPU: by type of object all that
/// was done for it on either node; "JPEG" is the encoder, and every other stage has its name. They add up to
/// measure::FrameCost::perUser() of all.
[[nodiscard]] std::map<std::string, double> layersOf(const measure::Reading& before, const measure::Reading& after,
                                                     const measure::Served& served);

}  // namespace grove::cli
