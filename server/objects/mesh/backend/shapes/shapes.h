#pragma once

#include <cstdint>

#include "raster/surface.h"

/// Generated shapes. Deterministic: a seed gives the same triangles on every machine.
namespace grove::objects::mesh {

/// Metres.
struct Size {
  float height = 3.0F;
  float width = 1.3F;
  float depth = 0.7F;
};

/// A weathered megalith: a tapered, leaning slab with broken edges, stained and overgrown. Stands on y = 0 and extends
/// a little below it.
[[nodiscard]] raster::Surface makeStandingStone(const Size& size, std::uint32_t seed);

/// The same rock lying flat, as across two standing stones: `width` is its length. Its underside is at y = 0.
[[nodiscard]] raster::Surface makeLintel(const Size& size, std::uint32_t seed);

/// Boulders scattered over `width` x `depth`, the largest `height` high.
[[nodiscard]] raster::Surface makeRocks(const Size& size, std::uint32_t seed);

/// A camp fire's crossed charred logs in a ring of stones, `width` across; `height` is the height of the logs' tips.
[[nodiscard]] raster::Surface makeLogs(const Size& size, std::uint32_t seed);

}  // namespace grove::objects::mesh
