#include "objects/figure/backend/contact_shadow.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace grove::objects::figure {
namespace {

using world::Vec3;

constexpr float kDarkest = 0.6F;  // opacity in the middle
/// Metres above the ground: what stands in the shadow is blades of grass.
constexpr float kPlane = 0.1F;

/// Black of that opacity.
std::uint32_t shade(float opacity) { return static_cast<std::uint32_t>(std::lround(255.0F * opacity)) << 24U; }

/// Makes a row's span hold the columns from `begin` to before `end`, empty where it is new.
void widen(raster::Image& picture, int row, int begin, int end) {
  if (picture.spans.empty()) return;
  raster::Span& span = picture.spans[static_cast<std::size_t>(row)];
  const bool isEmpty = span.begin >= span.end;
  const raster::Span wide{isEmpty ? begin : std::min(begin, span.begin), isEmpty ? end : std::max(end, span.end)};
  for (int x = wide.begin; x < wide.end; ++x) {
    if (!isEmpty && x >= span.begin && x < span.end) continue;
    picture.colourRow(row)[x] = 0;
    picture.depthRow(row)[x] = world::kInfiniteDepth;
  }
  span = wide;
}

}  // namespace

void layContactShadow(Vec3 place, const world::Camera& camera, raster::Image& picture) {
  place.y += kPlane;
  const Vec3 reach(kShadowRadius, 0.0F, kShadowRadius);
  const world::Rect rect =
      world::overlap(camera.screenRect({place - reach, place + reach + Vec3(0.0F, 0.01F, 0.0F)}), picture.rect);
  if (rect.empty()) return;
  for (int y = rect.top; y < rect.bottom; ++y) {
    const int row = y - picture.rect.top;
    widen(picture, row, rect.left - picture.rect.left, rect.right - picture.rect.left);
    for (int x = rect.left; x < rect.right; ++x) {
      const Vec3 ray = camera.ray(static_cast<float>(x) + 0.5F, static_cast<float>(y) + 0.5F);
      const float depth = (place.y - camera.pose.position.y) / ray.y;
      if (!(depth > camera.nearDepth)) continue;
      const Vec3 off = camera.pose.position + depth * ray - place;
      const float free = 1.0F - glm::dot(off, off) / (kShadowRadius * kShadowRadius);
      float& shown = picture.depthRow(row)[x - picture.rect.left];
      if (free <= 0.0F || shown < world::kInfiniteDepth) continue;
      shown = depth;
      picture.colourRow(row)[x - picture.rect.left] = shade(kDarkest * free * free);
    }
  }
}

}  // namespace grove::objects::figure
