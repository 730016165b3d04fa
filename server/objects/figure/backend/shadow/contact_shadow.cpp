#include "objects/figure/backend/shadow/contact_shadow.h"

#include <algorithm>
#include <cmath>

namespace grove::objects::figure {
namespace {

constexpr float kDarkest = 0.6F;  // opacity in the middle

}  // namespace

void addContactShadow(world::Vec3 place, const GroundRow& row, RowShade& shade) {
  place.y += world::kShadowPlane;
  const float pixel = glm::length(row.step);
  const world::Vec3 off = row.first - place;
  const float along = glm::dot(off, row.step) / pixel;
  const float remaining = kShadowRadius * kShadowRadius - (glm::dot(off, off) - along * along);
  if (remaining <= 0.0F) return;
  const float middle = -along / pixel;
  const float reach = std::sqrt(remaining) / pixel;
  const Columns covered = Columns::between(middle - reach, middle + reach, shade.columns());
  if (covered.empty()) return;
  shade.use(covered);
  for (int x = covered.begin; x < covered.end; ++x) {
    const float side = (static_cast<float>(x) + 0.5F - middle) * pixel;
    const float free = std::max(0.0F, remaining - side * side) / (kShadowRadius * kShadowRadius);
    *shade.sky(x) = kDarkest * free * free;
  }
}

}  // namespace grove::objects::figure
