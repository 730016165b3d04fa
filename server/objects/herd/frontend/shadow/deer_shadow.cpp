#include "objects/herd/frontend/shadow/deer_shadow.h"

#include <algorithm>

#include "objects/herd/frontend/shadow/deer_shadow_kernels.h"
#include "world/ground/ground_shadow.h"

namespace grove::objects::herd {
namespace {

using world::Vec3;

/// Below this share of the sun, its shadow is invisible.
constexpr float kFaintest = 0.04F;

/// Horizontal unit vector.
world::Vec2 awayFrom(Vec3 sun) { return -glm::normalize(world::Vec2(sun.x + 1.0e-6F, sun.z)); }

/// Corners of the space in which the ground may be darkened.
std::array<Vec3, 16> cornersOf(const Ground& ground, std::span<const Capsule> casters, const Contact& contact,
                               Vec3 place, Vec3 sun, bool hasSun) {
  const world::Vec2 level = awayFrom(sun);
  const Vec3 away(level.x, 0.0F, level.y);
  const Vec3 aside(-away.z, 0.0F, away.x);
  const float perMetre = glm::length(world::shadowPerMetre(sun));
  const float middle = glm::dot(place, aside);
  const float start = glm::dot(place, away);
  float left = middle;
  float right = middle;
  float end = start;
  if (hasSun) {
    for (const Capsule& each : casters) {
      for (const auto& [at, radius] : {std::pair(each.from, each.fromRadius), std::pair(each.to, each.toRadius)}) {
        const float across = glm::dot(at, aside);
        left = std::min(left, across - radius);
        right = std::max(right, across + radius);
        const float height = std::max(0.0F, ground.height.at(at)) + radius;
        end = std::max(end, glm::dot(at, away) + radius + std::min(perMetre * height, world::kLongestShadow));
      }
    }
  }
  const float around = contact.radius;
  const auto corner = [&](float along, float across, float above) {
    const Vec3 point = ground.below(along * away + across * aside);
    return Vec3(point.x, point.y + above, point.z);
  };
  const float bend = kGroundBend * (end - start);
  std::array<Vec3, 16> corners;
  std::size_t i = 0;
  for (const bool isHigh : {false, true}) {
    const float near = isHigh ? kShadeFadesTo : kLowestShade;
    const float far = isHigh ? kShadeFadesTo + bend : kLowestShade - bend;
    for (const float across : {middle - around, middle + around}) {
      corners[i++] = corner(start - around, across, near);
      corners[i++] = corner(start + around, across, near);
    }
    for (const float across : {left, right}) {
      corners[i++] = corner(start, across, near);
      corners[i++] = corner(end, across, far);
    }
  }
  return corners;
}

}  // namespace

DeerShadow::DeerShadow(const AnimalPose& pose, float size, const Capsules& casters, float sunShare,
                       const world::Sky& sky, const world::Camera& camera, const world::Rect& frame)
    : ground_(pose),
      place_(pose.place),
      away_(awayFrom(sky.sun)),
      sunStrength_(sky.sun.y > 0.0F && sunShare > kFaintest ? sunShare : 0.0F),
      contact_(pose, size, ground_),
      hull_(cornersOf(ground_, casters, contact_, pose.place, sky.sun, sunStrength_ > 0.0F), camera, frame) {
  if (sunStrength_ > 0.0F && !rect().empty()) mask_ = SunMask(casters, sky.sun, ground_.point);
}

void DeerShadow::draw(const world::Camera& camera, const raster::Image* body, raster::Image& frame) const {
  const GroundShade shade{mask_.texels(), sunStrength_, away_, contact_};
  const PixelRays rays(camera);
  const world::Vec3 eye = rays.eye;
  const Affine x{{1.0F, 0.0F, 0.0F}, -place_.x};
  const Affine z{{0.0F, 0.0F, 1.0F}, -place_.z};
  for (int y = rect().top; y < rect().bottom; ++y) {
    const raster::Span span = hull_.row(y);
    if (span.begin >= span.end) continue;
    const world::Vec3 ray = rays.of(span.begin, y);
    const auto along = [&](const Affine& value) { return AffineRow(value, eye, ray, rays.right); };
    const std::ptrdiff_t first = span.begin - frame.rect.left;
    ShadeRow row{.height = along(ground_.height),
                 .column = along(mask_.column()),
                 .line = along(mask_.line()),
                 .x = along(x),
                 .z = along(z),
                 .depths = frame.depthRow(y - frame.rect.top) + first,
                 .colours = frame.colourRow(y - frame.rect.top) + first,
                 .count = span.end - span.begin};
    if (body != nullptr && y >= body->rect.top && y < body->rect.bottom) {
      const int line = y - body->rect.top;
      const raster::Span own = body->span(line);
      row.bodyDepths = body->depthRow(line) + own.begin;
      row.bodyBegin = body->rect.left + own.begin - span.begin;
      row.bodyEnd = body->rect.left + own.end - span.begin;
    }
    shadeGround(shade, row);
  }
}

}  // namespace grove::objects::herd
