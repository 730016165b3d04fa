#pragma once

#include <cstdint>
#include <vector>

#include "measure/pictures/picture_quality.h"

namespace grove::measure {

/// Returns the picture in another size, interpolated linearly, as browsers show it.
[[nodiscard]] std::vector<std::uint32_t> enlarged(const Picture& picture, int width, int height);

}  // namespace grove::measure
