#include "objects/figure/backend/shadow/sun_shadow.h"

#include <algorithm>
#include <cmath>

#include "world/light.h"

namespace grove::objects::figure {
namespace {

using world::Vec2;
using world::Vec3;

/// Rows of the mask from one look at the sun to the next: about as many metres as between two places of GroundSun.
constexpr std::size_t kRowsPerLook = 4;
/// Metres from the eye from which it fades.
constexpr float kFadesFrom = 30.0F;
/// Share of kLongestShadow after which it fades.
constexpr float kFadesAfter = 0.7F;
/// Of meadows, linear.
const Vec3 kAlbedo{0.12F, 0.15F, 0.045F};
/// Sun that grass reflects, as a share of what faces the sun: seen from the side, and in addition when seen against the
/// sun, which shines through the blades. See the ground's own light.
constexpr float kReflected = 0.65F;
constexpr float kShoneThrough = 1.0F;

/// The displayed colour of grass, 0..1.
struct Meadow {
  Vec3 lit;
  Vec3 shaded;

  /// `way` is a unit vector from the eye.
  Meadow(const world::Sky& sky, Vec3 way) {
    const float square = std::pow(std::max(0.0F, glm::dot(way, sky.sun)), 2.0F);
    const Vec3 ambient = sky.ambient({0, 1, 0});
    const Vec3 direct = sky.sunColour * (kReflected + kShoneThrough * square * square);
    for (int i = 0; i < 3; ++i) {
      shaded[i] = world::toDisplay(kAlbedo[i] * ambient[i]);
      lit[i] = world::toDisplay(kAlbedo[i] * (ambient[i] + direct[i]));
    }
  }

  /// Of red, which loses most.
  [[nodiscard]] float sunsShare() const { return 1.0F - shaded.r / lit.r; }

  /// What is left of other colours beyond that: the sky is blue.
  [[nodiscard]] Vec3 skysColour() const {
    const float share = sunsShare();
    return glm::clamp((shaded - (1.0F - share) * lit) / share, 0.0F, 1.0F);
  }
};

/// The columns between the places where a row meets two ends of the mask in one direction.
Columns within(float first, float step, float low, float high, const Columns& columns) {
  if (std::abs(step) < 1e-9F) return first > low && first < high ? columns : Columns{};
  const float a = (low - first) / step;
  const float b = (high - first) / step;
  return Columns::between(std::min(a, b), std::max(a, b), columns);
}

}  // namespace

SunShadow::SunShadow(Vec3 place, const ShadowMask& mask, const SunView& view, const GroundSun& ground,
                     const world::Sky& sky, const world::Camera& camera)
    : place_(place),
      view_(view),
      camera_(camera),
      low_(mask.low),
      high_(mask.high.x, std::min(mask.high.y, world::kShadowPlane + world::kLongestShadow * view.slope)),
      perMetre_(Vec2(kShadowColumns, kShadowRows) / (mask.high - mask.low)),
      colour_(Meadow(sky, glm::normalize(place + 0.5F * world::shadowPerMetre(sky.sun) - camera.pose.position))
                  .skysColour()) {
  constexpr float kPerShare = 65535.0F / 255.0F;
  texels_.resize(mask.opacity.size());
  const std::uint8_t* opacity = mask.opacity.data();
  std::uint16_t* to = texels_.data();
  for (const float strength : strengths(mask, ground, sky)) {
    const auto scale = static_cast<std::uint32_t>(256.0F * kPerShare * strength);
    for (std::size_t column = 0; column < kShadowColumns; ++column) {
      *to++ = static_cast<std::uint16_t>(*opacity++ * scale >> 8U);
    }
  }
}

std::array<float, kShadowRows> SunShadow::strengths(const ShadowMask& mask, const GroundSun& ground,
                                                    const world::Sky& sky) const {
  const auto lookAt = [&](std::size_t row) {
    const float height = glm::mix(mask.low.y, mask.high.y, static_cast<float>(row) / kShadowRows);
    const Vec3 point = onGround({0.0F, height});
    const float length = (height - world::kShadowPlane) / view_.slope / world::kLongestShadow;
    return darkestAt(point, sky) * ground.at(point.x, point.z) * (1.0F - glm::smoothstep(kFadesAfter, 1.0F, length));
  };
  std::array<float, kShadowRows> strengths;
  float before = lookAt(0);
  for (std::size_t row = 0; row < kShadowRows; row += kRowsPerLook) {
    const float after = lookAt(row + kRowsPerLook);
    for (std::size_t i = 0; i < kRowsPerLook; ++i) {
      strengths[row + i] = glm::mix(before, after, (static_cast<float>(i) + 0.5F) / kRowsPerLook);
    }
    before = after;
  }
  return strengths;
}

void SunShadow::add(const GroundRow& row, float weight, RowShade& shade) const {
  const Vec2 first = view_.of(row.first - place_);
  const Vec2 step(glm::dot(row.step, view_.side), glm::dot(row.step, view_.away) * view_.slope);
  const Columns across = within(first.x, step.x, low_.x, high_.x, shade.columns());
  const Columns columns = within(first.y, step.y, low_.y, high_.y, across);
  if (columns.empty()) return;
  shade.use(columns);
  const Vec2 begin = first + (static_cast<float>(columns.begin) + 0.5F) * step;
  const TexelLine line{texels_.data(), static_cast<int>(kShadowColumns), static_cast<int>(kShadowRows),
                       (begin - low_) * perMetre_ - 0.5F, step * perMetre_};
  addTexels(line, weight, columns.end - columns.begin, shade.sun(columns.begin));
}

std::array<world::Bounds, SunShadow::kPieces> SunShadow::pieces() const {
  std::array<world::Bounds, kPieces> pieces;
  for (std::size_t i = 0; i < kPieces; ++i) {
    for (const std::size_t end : {i, i + 1}) {
      const float height = glm::mix(low_.y, high_.y, static_cast<float>(end) / kPieces);
      for (const float side : {low_.x, high_.x}) pieces[i].add(onGround({side, height}));
    }
  }
  return pieces;
}

Vec3 SunShadow::onGround(Vec2 place) const {
  return place_ + place.x * view_.side + (place.y - world::kShadowPlane) / view_.slope * view_.away +
         Vec3(0.0F, world::kShadowPlane, 0.0F);
}

float SunShadow::darkestAt(Vec3 point, const world::Sky& sky) const {
  const Vec3 way = point - camera_.pose.position;
  const float distance = glm::length(way);
  const float clear = (1.0F - world::hazeAmount(distance)) * (1.0F - world::mistAmount(distance));
  const float near = 1.0F - glm::smoothstep(kFadesFrom, kFarthest, distance);
  return Meadow(sky, way / std::max(distance, 1e-3F)).sunsShare() * clear * near;
}

}  // namespace grove::objects::figure
