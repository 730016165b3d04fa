#include "objects/figure/backend/contact_shadow.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

namespace grove::objects::figure {
namespace {

using world::Vec3;

constexpr float kDarkest = 0.6F;  // opacity in the middle
/// Metres above the ground: the shadow falls on blades of grass.
constexpr float kPlane = 0.1F;

/// Black with this opacity.
std::uint32_t shade(float opacity) { return static_cast<std::uint32_t>(std::lround(255.0F * opacity)) << 24U; }

/// Extends a row's span to the columns from `begin` to before `end`; fills the new ones with transparent pixels.
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

/// The intersection of a row of pixels with the shadow. The camera does not roll, so depth is constant along the row.
struct Crossing {
  float depth;      ///< metres
  float middle;     ///< column nearest to the place
  float pixel;      ///< metres per pixel along the row
  float remaining;  ///< squared radius minus the row's squared distance from the place
};

/// Columns that the shadow covers.
struct Columns {
  int begin;
  int end;
};

std::optional<Crossing> crossingOf(float row, Vec3 place, const world::Camera& camera) {
  const world::Pose& pose = camera.pose;
  const float half = 0.5F * static_cast<float>(camera.height);
  const Vec3 ray = pose.forward() + (half - row) / camera.focal() * pose.up();
  const float depth = (place.y - pose.position.y) / ray.y;
  if (!(depth > camera.nearDepth) || depth > camera.farDepth) return std::nullopt;
  const Vec3 off = pose.position + depth * ray - place;
  const float along = glm::dot(off, pose.right());
  const float remaining = kShadowRadius * kShadowRadius - (glm::dot(off, off) - along * along);
  if (remaining <= 0.0F) return std::nullopt;
  const float pixel = depth / camera.focal();
  return Crossing{depth, 0.5F * static_cast<float>(camera.width) - along / pixel, pixel, remaining};
}

Columns columnsOf(const Crossing& crossing, const world::Rect& rect) {
  const float reach = std::sqrt(crossing.remaining) / crossing.pixel;
  const auto clamped = [&](float column) {
    return static_cast<int>(std::clamp(column, static_cast<float>(rect.left), static_cast<float>(rect.right)));
  };
  return {clamped(std::ceil(crossing.middle - reach - 0.5F)), clamped(std::floor(crossing.middle + reach + 0.5F))};
}

}  // namespace

void layContactShadow(Vec3 place, const world::Camera& camera, raster::Image& picture) {
  place.y += kPlane;
  const world::Rect& rect = picture.rect;
  for (int y = rect.top; y < rect.bottom; ++y) {
    const std::optional<Crossing> crossing = crossingOf(static_cast<float>(y) + 0.5F, place, camera);
    if (!crossing) continue;
    const Columns columns = columnsOf(*crossing, rect);
    if (columns.begin >= columns.end) continue;
    const int row = y - rect.top;
    widen(picture, row, columns.begin - rect.left, columns.end - rect.left);
    for (int x = columns.begin; x < columns.end; ++x) {
      const float along = (static_cast<float>(x) + 0.5F - crossing->middle) * crossing->pixel;
      const float free = (crossing->remaining - along * along) / (kShadowRadius * kShadowRadius);
      float& shown = picture.depthRow(row)[x - rect.left];
      if (free <= 0.0F || shown < world::kInfiniteDepth) continue;
      shown = crossing->depth;
      picture.colourRow(row)[x - rect.left] = shade(kDarkest * free * free);
    }
  }
}

}  // namespace grove::objects::figure
