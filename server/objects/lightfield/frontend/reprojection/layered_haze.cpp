#include "objects/lightfield/frontend/reprojection/layered_haze.h"

#include "objects/lightfield/common/object_view.h"
#include "world/light.h"

namespace grove::objects::lightfield {

LayeredHaze::LayeredHaze(const world::Bounds& worldBounds, const world::Sky& sky, const world::Camera& camera)
    : haze_(hazeBefore(worldBounds, sky, camera)) {
  const world::Vec3 towards = worldBounds.centre() - camera.pose.position;
  const float distance = glm::length(world::Vec2(towards.x, towards.z));
  mist_ = world::mistAmount(distance);
  if (mist_ == 0.0F || camera.height <= 0) return;
  // In the frame's middle column, at the object's distance along the ground.
  const float middle = 0.5F * static_cast<float>(camera.width);
  const auto heightAt = [&](float row) {
    const world::Vec3 ray = camera.ray(middle, row);
    return camera.pose.position.y + distance * ray.y / glm::length(world::Vec2(ray.x, ray.z));
  };
  const auto rows = static_cast<float>(camera.height);
  firstHeight_ = heightAt(0.0F);
  perRow_ = (heightAt(rows) - firstHeight_) / rows;
}

TileHaze LayeredHaze::at(int row, int rows) const {
  TileHaze tile{haze_};
  if (mist_ == 0.0F) return tile;
  tile.first.amount = amountAt(static_cast<float>(row) + 0.5F);
  tile.perRow = (amountAt(static_cast<float>(row + rows) + 0.5F) - tile.first.amount) / static_cast<float>(rows);
  return tile;
}

float LayeredHaze::amountAt(float row) const {
  const float mist = mist_ * (1.0F - glm::smoothstep(0.0F, world::kMistTop, firstHeight_ + row * perRow_));
  return 1.0F - (1.0F - haze_.amount) * (1.0F - mist);
}

}  // namespace grove::objects::lightfield
