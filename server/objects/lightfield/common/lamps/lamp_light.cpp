#include "objects/lightfield/common/lamps/lamp_light.h"

#include <algorithm>
#include <array>

#include "objects/lightfield/common/lamps/lamp_kernels.h"

namespace grove::objects::lightfield {
namespace {

using world::Vec3;

constexpr float kLampGain = 1.6F;  // for a surface that is mid grey in display-encoded colour

/// Columns and rows of the parts that share a choice of lamps.
constexpr int kPartWidth = 32;
constexpr int kPartHeight = 16;

/// The bounds of a part's visible points; inverted if the part is empty.
world::Bounds boundsOf(const ObjectCamera& camera, const PicturePart& part) {
  const DepthRange range = depthRange(part);
  world::Bounds bounds{Vec3(kRelightFarthest), Vec3(-kRelightFarthest)};
  if (range.farthest <= 0.0F) return bounds;
  for (const int x : {part.rect.left, part.rect.right}) {
    for (const int y : {part.rect.top, part.rect.bottom}) {
      const Vec3 ray = camera.ray(static_cast<float>(x), static_cast<float>(y));
      for (const float t : {range.nearest, range.farthest}) {
        bounds.low = glm::min(bounds.low, camera.eye + t * ray);
        bounds.high = glm::max(bounds.high, camera.eye + t * ray);
      }
    }
  }
  return bounds;
}

}  // namespace

LampLight::LampLight(std::span<const world::PointLight> lamps, const ObjectCamera& camera)
    : camera_(camera), count_(std::min(lamps.size(), kMaxLamps)) {
  std::copy_n(lamps.begin(), count_, lamps_.begin());
  for (world::PointLight& lamp : lamps_) lamp.colour *= kLampGain;
}

void LampLight::addTo(const world::Rect& part, std::uint32_t* colour, const float* depth, std::ptrdiff_t stride) const {
  if (count_ == 0) return;
  const PicturePart pixels{colour, depth, stride, part};
  const world::Bounds bounds = boundsOf(camera_, pixels);
  std::array<world::PointLight, kMaxLamps> reaching;
  std::size_t count = 0;
  for (const world::PointLight& lamp : std::span(lamps_).first(count_)) {
    const Vec3 apart = lamp.position - glm::max(bounds.low, glm::min(lamp.position, bounds.high));
    if (glm::dot(apart, apart) < kLampReach * kLampReach) reaching[count++] = lamp;
  }
  if (count == 0) return;
  lightPart(std::span(reaching).first(count), camera_, pixels);
}

void LampLight::addTo(raster::Image& image) const {
  const world::Rect& rect = image.rect;
  for (int y = rect.top; y < rect.bottom; y += kPartHeight) {
    for (int x = rect.left; x < rect.right; x += kPartWidth) {
      const world::Rect part{x, y, std::min(x + kPartWidth, rect.right), std::min(y + kPartHeight, rect.bottom)};
      const std::ptrdiff_t at = std::ptrdiff_t{y - rect.top} * image.width() + x - rect.left;
      addTo(part, image.colour.data() + at, image.depth.data() + at, image.width());
    }
  }
}

}  // namespace grove::objects::lightfield
