#pragma once

#include <span>

namespace grove::objects::mesh {

/// Turns reversed window depth (near / view depth, 0 for nothing) into view depth in metres, in place.
void toViewDepth(std::span<float> depth, float nearDepth) noexcept;

}  // namespace grove::objects::mesh
