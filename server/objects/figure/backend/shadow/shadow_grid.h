#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "objects/figure/backend/shadow/shadow_caster.h"

namespace grove::objects::figure {

inline constexpr std::size_t kShadowColumns = 64;
inline constexpr std::size_t kShadowRows = 128;

/// A figure's shadow while it is made: shares of 0..1, the rows upwards.
using ShadowRow = std::array<float, kShadowColumns>;
using ShadowGrid = std::vector<ShadowRow>;

/// The share of each texel that a caster covers, from four samples. `corners` are where the sun sees its vertices;
/// `low` is where the first texel begins, `texel` is the size of one.
[[nodiscard]] ShadowGrid silhouette(const ShadowCaster& caster, std::span<const world::Vec2> corners, world::Vec2 low,
                                    world::Vec2 texel);

/// Averages each texel with its neighbours, up to as many texels across and along as given for its row.
void soften(ShadowGrid& grid, std::span<const world::Vec2> radii);

}  // namespace grove::objects::figure
