#include "objects/fluid/frontend/smoke_sprites.h"

#include <algorithm>
#include <cmath>

#include "objects/fluid/frontend/smoke_sprites_kernels.h"

namespace grove::objects::fluid {

void SmokeSprites::resize(std::size_t particles) {
  count = particles;
  const std::size_t needed = (particles + kMaxLanes - 1) / kMaxLanes * kMaxLanes;
  if (needed <= x.size()) return;
  for (std::vector<float>* array : {&x,     &y,     &depth,   &radius,   &heat, &ember,     &age,        &life,   &fade,
                                    &axisX, &axisY, &xx,      &xy,       &yy,   &halfWidth, &halfHeight, &shrink, &red,
                                    &green, &blue,  &opacity, &softness, &rank, &chanceA,   &chanceB,    &chanceC}) {
    array->resize(needed);
  }
  seen.resize(needed);
}

SmokeLens::SmokeLens(const world::Camera& camera)
    : eye(camera.pose.position),
      right(camera.pose.right()),
      up(camera.pose.up()),
      forward(camera.pose.forward()),
      focal(camera.focal()),
      middleX(0.5F * static_cast<float>(camera.width)),
      middleY(0.5F * static_cast<float>(camera.height)),
      nearDepth(camera.nearDepth) {}

void project(const FluidSnapshot& snapshot, const world::Camera& camera, float lead, SmokeSprites& sprites) {
  sprites.resize(snapshot.count());
  projectSprites(snapshot, SmokeLens(camera), lead, sprites);
}

void shape(const world::Camera& camera, int scale, SmokeSprites& sprites) {
  shapeSprites(SmokeLens(camera), 1.1F * static_cast<float>(scale), sprites);
}

world::Rect collectVisible(const world::Camera& camera, SmokeSprites& sprites, std::vector<std::uint32_t>& order) {
  const auto width = static_cast<float>(camera.width);
  const auto height = static_cast<float>(camera.height);
  const SpriteBounds box = markSeen(width, height, camera.nearDepth, camera.farDepth, sprites);
  order.resize(sprites.count);
  std::size_t found = 0;
  for (std::size_t i = 0; i < sprites.count; ++i) {
    order[found] = static_cast<std::uint32_t>(i);
    found += sprites.seen[i];
  }
  order.resize(found);
  if (order.empty()) return {};
  return {static_cast<int>(std::max(box.left, 0.0F)), static_cast<int>(std::max(box.top, 0.0F)),
          static_cast<int>(std::ceil(std::min(box.right, width))),
          static_cast<int>(std::ceil(std::min(box.bottom, height)))};
}

}  // namespace grove::objects::fluid
