#include "objects/lightfield/frontend/near_margins.h"

#include <algorithm>
#include <cmath>

namespace grove::objects::lightfield {
namespace {

/// Smallest and largest margin in pixels beyond the frame's edges.
constexpr world::Vec2 kMin{32.0F, 24.0F};
constexpr world::Vec2 kMax{256.0F, 160.0F};
/// Empty texels beside an object that ends within the frame, which prove that it ends there.
constexpr float kClear = kClearTexels + 1.0F;
/// Angle that a margin covers, relative to the turn since the last picture.
constexpr float kTimesLastTurn = 2.0F;

/// Pixels by which the frame exceeds the last picture's because the head has turned.
Sides turnSince(const NearView& last, const ObjectCamera& camera, world::Vec2 frame) {
  Sides beyond;
  if (!last.picture) return beyond;
  const ObjectCamera& own = last.picture->camera();
  const glm::mat3 toTexels = glm::inverse(glm::mat3(own.perColumn, own.perRow, own.corner));
  const float pixelsPerTexel = glm::length(own.perColumn) / glm::length(camera.perColumn);
  for (const world::Vec2 corner : {world::Vec2(0.0F), {frame.x, 0.0F}, {0.0F, frame.y}, frame}) {
    const world::Vec3 at = toTexels * camera.ray(corner.x, corner.y);
    if (at.z <= 0.0F) continue;
    const world::Vec2 before = pixelsPerTexel * world::Vec2(at) / at.z;
    beyond.left = std::max(beyond.left, -before.x);
    beyond.top = std::max(beyond.top, -before.y);
    beyond.right = std::max(beyond.right, before.x - frame.x);
    beyond.bottom = std::max(beyond.bottom, before.y - frame.y);
  }
  return beyond;
}

}  // namespace

world::Rect withMargins(const world::Rect& rect, const world::Camera& frame, const ObjectCamera& camera,
                        const NearView& last, float times) {
  const Sides turn = turnSince(last, camera, {frame.width, frame.height});
  const auto margin = [&](bool reachesEdge, float towards, float min, float max) {
    const float pixels = reachesEdge ? std::clamp(kTimesLastTurn * towards, min, max) : kClear * times;
    return static_cast<int>(std::ceil(pixels));
  };
  return {rect.left - margin(rect.left <= 0, turn.left, kMin.x, kMax.x),
          rect.top - margin(rect.top <= 0, turn.top, kMin.y, kMax.y),
          rect.right + margin(rect.right >= frame.width, turn.right, kMin.x, kMax.x),
          rect.bottom + margin(rect.bottom >= frame.height, turn.bottom, kMin.y, kMax.y)};
}

}  // namespace grove::objects::lightfield
