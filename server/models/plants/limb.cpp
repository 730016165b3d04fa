#include "models/plants/limb.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace grove::models {
namespace {

using world::Vec3;

/// A smooth curve through the points, after Catmull and Rom (1974).
Limb::Point curve(const std::vector<Limb::Point>& points, float at) {
  const auto last = static_cast<std::ptrdiff_t>(points.size()) - 1;
  const auto segment = std::clamp(static_cast<std::ptrdiff_t>(at), std::ptrdiff_t{0}, last - 1);
  const float t = at - static_cast<float>(segment);
  const auto point = [&](std::ptrdiff_t i) {
    return points[static_cast<std::size_t>(std::clamp(i, std::ptrdiff_t{0}, last))];
  };
  const Limb::Point p0 = point(segment - 1);
  const Limb::Point p1 = point(segment);
  const Limb::Point p2 = point(segment + 1);
  const Limb::Point p3 = point(segment + 2);
  const Vec3 position = 0.5F * (2.0F * p1.position + (p2.position - p0.position) * t +
                                (2.0F * p0.position - 5.0F * p1.position + 4.0F * p2.position - p3.position) * (t * t) +
                                (3.0F * (p1.position - p2.position) + p3.position - p0.position) * (t * t * t));
  return {position, glm::mix(p1.radius, p2.radius, t)};
}

/// Radius in metres of limbs whose bark is seen even in small detail.
constexpr float kThick = 0.04F;

/// Radius in metres of the thinnest limbs that are seen from a distance.
constexpr float kThinnest = 0.016F;

float spacingOf(float radius, Detail detail) {
  switch (detail) {
    case Detail::kFull:
      return radius > 0.02F ? 0.012F : 0.05F;
    case Detail::kSmall:
      return radius > kThick ? 0.05F : 0.12F;
    case Detail::kDistant:
      return 0.35F;
  }
  return 0.0F;
}

/// Resamples the curve with the detail's spacing.
std::vector<Limb::Point> resample(const std::vector<Limb::Point>& points, Detail detail) {
  std::vector<Limb::Point> fine{points.front()};
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const float length = glm::distance(points[i].position, points[i + 1].position);
    const float spacing = spacingOf(points[i].radius, detail);
    const int pieces = std::max(1, static_cast<int>(std::lround(length / spacing)));
    for (int piece = 1; piece <= pieces; ++piece) {
      fine.push_back(curve(points, static_cast<float>(i) + static_cast<float>(piece) / static_cast<float>(pieces)));
    }
  }
  return fine;
}

int sidesFor(float radius, Detail detail) {
  if (detail == Detail::kFull) return std::clamp(static_cast<int>(kTurn * radius / 0.008F), 5, 240);
  if (detail == Detail::kDistant) return radius > kThick ? 6 : 3;
  return std::clamp(static_cast<int>(kTurn * radius / (radius > kThick ? 0.025F : 0.05F)), 3, 80);
}

}  // namespace

Limb::Point Limb::at(float share) const {
  assert(points.size() >= 2);
  return curve(points, share * static_cast<float>(points.size() - 1));
}

Vec3 Limb::directionAt(float share) const {
  const float half = 0.5F / static_cast<float>(points.size());
  return unitOr(at(std::min(1.0F, share + half)).position - at(std::max(0.0F, share - half)).position, Vec3(0, 1, 0));
}

Limb grow(const Growth& growth, Random& random) {
  Limb limb;
  limb.points.push_back({growth.root, growth.rootRadius});
  Vec3 direction = growth.direction;
  Vec3 at = growth.root;
  const float step = growth.length / static_cast<float>(growth.steps);
  for (int i = 1; i <= growth.steps; ++i) {
    const float share = static_cast<float>(i) / static_cast<float>(growth.steps);
    const float up = growth.rise * std::max(0.0F, share - 0.6F) * 2.5F - growth.sag * share;
    direction = unitOr(direction + Vec3(0, up * step, 0) + random.direction() * growth.wander, direction);
    at += direction * step;
    limb.points.push_back({at, glm::mix(growth.rootRadius, growth.tipRadius, std::pow(share, 0.85F))});
  }
  return limb;
}

void drawLimb(MeshWriter& mesh, const Limb& limb, Bark bark, std::uint16_t material, Detail detail) {
  if (detail == Detail::kDistant && limb.points.front().radius < kThinnest) return;
  const std::vector<Limb::Point> points = resample(limb.points, detail);
  const int sides = sidesFor(points.front().radius, detail);
  Vec3 direction = unitOr(points[1].position - points[0].position, Vec3(0, 1, 0));
  Vec3 side = anyNormalTo(direction);
  float along = 0.0F;
  std::uint32_t before = 0;
  for (std::size_t ring = 0; ring < points.size(); ++ring) {
    const Vec3 at = points[ring].position;
    const float radius = points[ring].radius;
    if (ring > 0) along += glm::distance(at, points[ring - 1].position);
    direction = unitOr(
        points[std::min(ring + 1, points.size() - 1)].position - points[ring == 0 ? 0 : ring - 1].position, direction);
    side = unitOr(side - direction * glm::dot(side, direction), anyNormalTo(direction));
    const Vec3 other = glm::cross(direction, side);
    std::uint32_t first = 0;
    for (int i = 0; i < sides; ++i) {
      const float angle = kTurn * static_cast<float>(i) / static_cast<float>(sides);
      const Vec3 normal = side * std::cos(angle) + other * std::sin(angle);
      const Vec3 onLimb(radius * std::cos(angle), along, radius * std::sin(angle));
      const BarkLook look = bark({at + normal * radius, onLimb, normal, radius});
      const std::uint32_t vertex = mesh.vertex(at + normal * (radius + look.relief), look.colour);
      if (i == 0) first = vertex;
    }
    for (int i = 0; i < sides && ring > 0; ++i) {
      const auto here = static_cast<std::uint32_t>(i);
      const auto next = static_cast<std::uint32_t>((i + 1) % sides);
      mesh.triangle(before + here, before + next, first + here, material);
      mesh.triangle(before + next, first + next, first + here, material);
    }
    if (ring == 0 || ring + 1 == points.size()) {
      const BarkLook look = bark({at, Vec3(0, along, 0), direction, radius});
      const std::uint32_t middle = mesh.vertex(at + direction * (ring == 0 ? -0.3F * radius : radius), look.colour);
      for (int i = 0; i < sides; ++i) {
        const std::uint32_t here = first + static_cast<std::uint32_t>(i);
        const std::uint32_t next = first + static_cast<std::uint32_t>((i + 1) % sides);
        if (ring == 0) mesh.triangle(next, here, middle, material);
        if (ring != 0) mesh.triangle(here, next, middle, material);
      }
    }
    before = first;
  }
  mesh.finishSurface();
}

}  // namespace grove::models
