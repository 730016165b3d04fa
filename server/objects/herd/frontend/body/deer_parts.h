#pragma once

#include "objects/herd/common/deer_skeleton.h"
#include "objects/herd/frontend/body/deer_coat.h"
#include "raster/surface.h"

/// The parts of a deer's body, each a closed surface in the rest position that follows one bone. Those of neighbouring
/// bones overlap.
namespace grove::objects::herd {

/// A point of the trunk's skin, with the direction outwards. `angle`: 0 below, positive to the right.
[[nodiscard]] raster::Vertex skinAt(const Build& build, float z, float angle);

/// The trunk's skin near a point.
struct Skin {
  world::Vec3 normal{0.0F};
  float outside = 0.0F;  ///< metres from it to the point, negative below it
};
[[nodiscard]] Skin skinNear(const Build& build, world::Vec3 at);

[[nodiscard]] raster::Surface makePelvis(const Build& build);
[[nodiscard]] raster::Surface makeChest(const Build& build);
/// White spots on a half of the trunk: open surfaces on its skin.
[[nodiscard]] raster::Surface makeSpots(const Build& build, bool isChest);
[[nodiscard]] raster::Surface makeLowerNeck(const Build& build);
[[nodiscard]] raster::Surface makeUpperNeck(const Build& build);
[[nodiscard]] raster::Surface makeTail();

[[nodiscard]] raster::Surface makeSkull(const Build& build);
// `side`: -1 left, 1 right.
[[nodiscard]] raster::Surface makeEye(const Build& build, float side);
[[nodiscard]] raster::Surface makeEar(float side);
[[nodiscard]] raster::Surface makeBeam(float side);
[[nodiscard]] raster::Surface makeBrowTine(float side);
[[nodiscard]] raster::Surface makePalm(float side);

/// `part`: 0 to 2, from the trunk downwards.
[[nodiscard]] raster::Surface makeLegPart(const Build& build, Leg leg, std::size_t part);

}  // namespace grove::objects::herd
