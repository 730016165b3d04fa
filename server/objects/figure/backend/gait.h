#pragma once

#include <array>

#include "objects/figure/backend/figure_shape.h"
#include "world/object.h"
#include "world/players.h"

namespace grove::objects::figure {

inline constexpr float kTurn = 6.2831853F;    ///< radians
inline constexpr float kStrideMetres = 1.5F;  ///< two steps

/// How far a visitor's limbs swing: 0 standing, 1 walking or faster.
[[nodiscard]] float paceOf(const world::Player& player) noexcept;

/// Returns the world transforms of a visitor's bones. The distance walked drives the legs, so feet do not slide; the
/// legs come to rest with the visitor.
[[nodiscard]] std::array<world::Mat4, kBones> bonesOf(const world::Player& player, const world::Transform& transform);

}  // namespace grove::objects::figure
