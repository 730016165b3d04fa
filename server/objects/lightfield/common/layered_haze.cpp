#include "objects/lightfield/common/layered_haze.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

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

void LayeredHaze::addMistTo(raster::Image& picture) const {
  if (mist_ == 0.0F) return;
  for (int row = 0; row < picture.height(); ++row) {
    const float mist = mistAt(static_cast<float>(picture.rect.top + row) + 0.5F);
    for (std::uint32_t& pixel : std::span(picture.colourRow(row), static_cast<std::size_t>(picture.width()))) {
      const auto cover = static_cast<float>(pixel >> 24U);
      std::uint32_t mixed = pixel & 0xFF000000U;
      for (unsigned c = 0; c < 3; ++c) {
        const auto clear = static_cast<float>(pixel >> (8U * c) & 255U);
        mixed |= static_cast<std::uint32_t>(std::lround(clear + (haze_.colour[c] * cover - clear) * mist)) << (8U * c);
      }
      pixel = mixed;
    }
  }
}

float LayeredHaze::mistAt(float row) const {
  return mist_ * (1.0F - glm::smoothstep(0.0F, world::kMistTop, firstHeight_ + row * perRow_));
}

float LayeredHaze::amountAt(float row) const { return 1.0F - (1.0F - haze_.amount) * (1.0F - mistAt(row)); }

}  // namespace grove::objects::lightfield
