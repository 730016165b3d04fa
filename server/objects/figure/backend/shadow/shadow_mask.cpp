#include "objects/figure/backend/shadow/shadow_mask.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "objects/figure/backend/shadow/shadow_grid.h"
#include "objects/figure/common/stature.h"
#include "world/ground/ground_shadow.h"

namespace grove::objects::figure {
namespace {

using world::Vec2;
using world::Vec3;

/// Radians; larger than the real sun, as through haze. The shadows in the ground's light have the same.
constexpr float kSunRadius = 0.013F;
/// Metres by which blades of grass soften every shadow.
constexpr float kLeastPenumbra = 0.014F;
/// Of opacity, less a little: the highest is 255.
constexpr float kLevels = 255.99F;
/// Texels that stay empty at each end of the mask.
constexpr float kEmptyTexels = 1.5F;

/// Metres in a SunView, where the shadow of a point at this height falls.
float penumbraAt(float height, const SunView& sun) {
  const float distance = std::clamp(height, 0.0F, kFigureHeight) * std::sqrt(1.0F + 1.0F / (sun.slope * sun.slope));
  return kLeastPenumbra + kSunRadius * distance;
}

std::vector<Vec2> placesOf(std::span<const raster::Vertex> vertices, std::span<const world::Mat4> bones,
                           const SunView& sun) {
  std::vector<Vec2> places;
  places.reserve(vertices.size());
  for (const raster::Vertex& vertex : vertices) {
    const world::Mat4& bone = bones[static_cast<std::size_t>(vertex.bone)];
    Vec3 point(bone * world::Vec4(vertex.position, 1.0F));
    // What is below the plane that shows the shadow casts none on it.
    point.y = std::max(point.y, world::kShadowPlane);
    places.push_back(sun.of(point));
  }
  return places;
}

}  // namespace

SunView::SunView(Vec3 sun) noexcept
    // A sun right overhead gets some direction.
    : away(glm::normalize(Vec3(-sun.x, 0.0F, 1e-6F - sun.z))),
      side(glm::cross(away, Vec3(0, 1, 0))),
      slope(1.0F / std::max(glm::length(world::shadowPerMetre(sun)), 0.1F)) {}

ShadowMask castShadow(const ShadowCaster& caster, std::span<const world::Mat4> bones, const SunView& sun) {
  const std::vector<Vec2> places = placesOf(caster.vertices(), bones, sun);
  ShadowMask mask{Vec2(world::Bounds().low), Vec2(world::Bounds().high), {}};
  for (const Vec2 place : places) {
    mask.low = glm::min(mask.low, place);
    mask.high = glm::max(mask.high, place);
  }
  const float margin = penumbraAt(mask.high.y, sun);
  const Vec2 texel = (mask.high - mask.low + 2.0F * margin) / (Vec2(kShadowColumns, kShadowRows) - 2.0F * kEmptyTexels);
  mask.low -= margin + kEmptyTexels * texel;
  mask.high += margin + kEmptyTexels * texel;
  ShadowGrid grid = silhouette(caster, places, mask.low, texel);
  std::array<Vec2, kShadowRows> radii;
  for (std::size_t row = 0; row < kShadowRows; ++row) {
    radii[row] = penumbraAt(mask.low.y + (static_cast<float>(row) + 0.5F) * texel.y, sun) / texel;
  }
  soften(grid, radii);
  mask.opacity.resize(kShadowRows * kShadowColumns);
  std::uint8_t* to = mask.opacity.data();
  for (const ShadowRow& row : grid) {
    for (const float share : row) *to++ = static_cast<std::uint8_t>(kLevels * std::min(share, 1.0F));
  }
  return mask;
}

}  // namespace grove::objects::figure
