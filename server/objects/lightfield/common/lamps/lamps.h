#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "world/light.h"

namespace grove::objects::lightfield {

inline constexpr std::size_t kMaxLamps = 4;

/// Distance in metres at which a lamp's light ends.
inline constexpr float kLampReach = 7.0F;

/// The point lights with the largest effect on an object, in its own coordinates and metres.
[[nodiscard]] std::vector<world::PointLight> chooseLamps(std::span<const world::PointLight> lights,
                                                         const world::Bounds& worldBounds, const world::Mat4& toObject);

}  // namespace grove::objects::lightfield
