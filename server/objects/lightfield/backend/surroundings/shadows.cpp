#include "objects/lightfield/backend/surroundings/shadows.h"

#include "objects/lightfield/backend/surroundings/shadow_kernels.h"

namespace grove::objects::lightfield {

void castShadows(const SunGrid& sun, const ObjectCamera& camera, raster::Image& image) {
  if (sun.whole) return;
  shadePart(sun, camera, {image.colour.data(), image.depth.data(), image.width(), image.rect});
}

}  // namespace grove::objects::lightfield
