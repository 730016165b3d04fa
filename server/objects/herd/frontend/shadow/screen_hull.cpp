#include "objects/herd/frontend/shadow/screen_hull.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

namespace grove::objects::herd {
namespace {

using world::Vec2;
using world::Vec3;

int pixel(float value, int low, int high) {
  return static_cast<int>(std::floor(std::clamp(value, static_cast<float>(low), static_cast<float>(high))));
}

struct ScreenBox {
  Vec2 low{1.0e9F};
  Vec2 high{-1.0e9F};

  void add(Vec2 point) {
    low = glm::min(low, point);
    high = glm::max(high, point);
  }
};

/// Of the intersections of lines between corners with the near plane.
ScreenBox nearBox(std::span<const Vec3> corners, const world::Camera& camera) {
  const Vec3 forward = camera.pose.forward();
  const auto beyond = [&](Vec3 point) { return glm::dot(point - camera.pose.position, forward) - camera.nearDepth; };
  ScreenBox box;
  for (const Vec3& front : corners) {
    const float before = beyond(front);
    if (before < 0.0F) continue;
    for (const Vec3& back : corners) {
      const float behind = beyond(back);
      if (behind >= 0.0F) continue;
      const Vec3 d = glm::mix(front, back, before / (before - behind)) - camera.pose.position;
      const float scale = camera.focal() / camera.nearDepth;
      box.add({0.5F * static_cast<float>(camera.width) + glm::dot(d, camera.pose.right()) * scale,
               0.5F * static_cast<float>(camera.height) - glm::dot(d, camera.pose.up()) * scale});
    }
  }
  return box;
}

/// Positive if the way from a over b to c turns to one side, negative if to the other.
float turn(Vec2 a, Vec2 b, Vec2 c) { return (b.x - a.x) * (c.y - b.y) - (b.y - a.y) * (c.x - b.x); }

}  // namespace

ScreenHull::ScreenHull(std::span<const Vec3> corners, const world::Camera& camera, const world::Rect& within) {
  std::array<Vec2, kMostCorners + 4> points;
  assert(corners.size() <= kMostCorners);
  std::size_t count = 0;
  ScreenBox all;
  for (const Vec3& corner : corners) {
    const Vec3 at = camera.project(corner);
    if (at.z < camera.nearDepth) continue;
    points[count++] = Vec2(at);
    all.add(Vec2(at));
  }
  if (count == 0) return;
  if (count < corners.size()) {
    // What lies on the near plane is within the box of the edges' intersections with it.
    const ScreenBox near = nearBox(corners, camera);
    for (const Vec2 corner : {near.low, Vec2(near.low.x, near.high.y), Vec2(near.high.x, near.low.y), near.high}) {
      points[count++] = corner;
      all.add(corner);
    }
  }
  rect_ = {pixel(all.low.x, within.left, within.right), pixel(all.low.y, within.top, within.bottom),
           pixel(all.high.x + 1.0F, within.left, within.right), pixel(all.high.y + 1.0F, within.top, within.bottom)};
  if (rect_.empty()) return;
  rows_.assign(static_cast<std::size_t>(rect_.height()), {rect_.right, rect_.left});
  const std::span<Vec2> used(points.data(), count);
  std::ranges::sort(used, [](Vec2 a, Vec2 b) { return a.y < b.y || (a.y == b.y && a.x < b.x); });
  addSide(used, 1.0F);
  addSide(used, -1.0F);
}

void ScreenHull::addSide(std::span<const Vec2> downwards, float side) {
  std::array<Vec2, kMostCorners + 4> outer;
  std::size_t count = 0;
  for (const Vec2 point : downwards) {
    while (count > 1 && side * turn(outer[count - 2], outer[count - 1], point) <= 0.0F) --count;
    outer[count++] = point;
  }
  if (count == 1) addEdge(outer[0], outer[0]);
  for (std::size_t i = 1; i < count; ++i) addEdge(outer[i - 1], outer[i]);
}

void ScreenHull::addEdge(Vec2 a, Vec2 b) {
  const float slope = (b.x - a.x) / std::max(b.y - a.y, 1.0e-4F);
  const int bottom = pixel(b.y + 1.0F, rect_.top, rect_.bottom);
  for (int y = pixel(a.y, rect_.top, rect_.bottom); y < bottom; ++y) {
    const auto at = [&](float row) { return a.x + slope * (std::clamp(row, a.y, b.y) - a.y); };
    const float from = at(static_cast<float>(y));
    const float to = at(static_cast<float>(y + 1));
    raster::Span& span = rows_[static_cast<std::size_t>(y - rect_.top)];
    span.begin = std::min(span.begin, pixel(std::min(from, to), rect_.left, rect_.right));
    span.end = std::max(span.end, pixel(std::max(from, to) + 1.0F, rect_.left, rect_.right));
  }
}

}  // namespace grove::objects::herd
