#pragma once

#include <cstddef>

namespace grove::measure {

/// Bytes of this process that are in physical memory, mapped files too. 0 if the system does not tell.
[[nodiscard]] std::size_t residentBytes();

}  // namespace grove::measure
