#include "node/frontend/backdrops/backdrop_area.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/floor_to.h"
#include "node/frontend/backdrops/backdrop.h"
#include "node/frontend/backdrops/warp_camera.h"

namespace grove::node {
namespace {

/// Border beyond the expected area: a share of that, and pixels.
constexpr float kSpareShare = 1.15F;
constexpr int kSpare = 2;
/// Pixels of an area in multiples of the frame's: if it is drawn, and if it is extended.
constexpr float kMaxDrawn = 1.3F;
constexpr float kMaxExtended = 2.0F;

/// Pixels, of rays that are almost parallel to the backdrop.
constexpr float kFarOut = 1.0e6F;

/// Pixels that rounding may add to an edge.
constexpr float kRoundingError = 0.02F;

/// Rounds away from zero to an even number, because areas have even edges.
int evenUp(float value) { return 2 * static_cast<int>(std::ceil(0.5F * (value - kRoundingError))); }
int evenDown(float value) { return 2 * static_cast<int>(std::floor(0.5F * (value + kRoundingError))); }

/// The part that is visible now, and a border on the sides where more becomes visible later.
world::Rect withBorder(const world::Rect& seen, const world::Rect& later) {
  const auto border = [](int beyond) {
    return beyond > 0 ? static_cast<int>(std::ceil(kSpareShare * static_cast<float>(beyond))) + kSpare : 0;
  };
  return wholeCells({seen.left - border(seen.left - later.left), seen.top - border(seen.top - later.top),
                     seen.right + border(later.right - seen.right), seen.bottom + border(later.bottom - seen.bottom)});
}

bool isWithin(float limit, const world::Rect& area, const world::Camera& camera) {
  const auto pixels = [](int width, int height) { return static_cast<float>(width) * static_cast<float>(height); };
  return pixels(area.width(), area.height()) <= limit * pixels(camera.width, camera.height);
}

struct Box {
  float left = std::numeric_limits<float>::max();
  float top = std::numeric_limits<float>::max();
  float right = std::numeric_limits<float>::lowest();
  float bottom = std::numeric_limits<float>::lowest();
  void add(world::Vec2 point) {
    left = std::min(left, point.x);
    top = std::min(top, point.y);
    right = std::max(right, point.x);
    bottom = std::max(bottom, point.y);
  }
};

}  // namespace

world::Rect seenPart(const world::Camera& backdrop, const world::Camera& frame, float nearest) {
  const WarpCamera warp(backdrop, frame);
  Box box;
  // The edges are straight in the backdrop, too.
  for (const float x : {0.0F, static_cast<float>(frame.width)}) {
    for (const float y : {0.0F, static_cast<float>(frame.height)}) {
      const world::Vec3 k = warp.at(x, y);
      if (k.z < kMinForward) return {};
      const world::Vec2 far = world::Vec2(k) / k.z;
      box.add(far);
      box.add(far + warp.shiftPerNearness(far) / nearest);
    }
  }
  const auto limited = [](float value) { return std::clamp(value, -kFarOut, kFarOut); };
  return {evenDown(limited(box.left)), evenDown(limited(box.top)), evenUp(limited(box.right)),
          evenUp(limited(box.bottom))};
}

std::optional<world::Rect> areaWithBorder(const world::Rect& seen, const world::Rect& later,
                                          const world::Camera& camera) {
  if (later.empty()) return std::nullopt;
  const world::Rect area = withBorder(seen, later);
  if (!isWithin(kMaxDrawn, area, camera)) return std::nullopt;
  return area;
}

world::Rect wholeCells(const world::Rect& rect) {
  constexpr int kCell = Backdrop::kCell;
  return {floorTo(rect.left, kCell), floorTo(rect.top, kCell), -floorTo(-rect.right, kCell),
          -floorTo(-rect.bottom, kCell)};
}

std::optional<world::Rect> extendedArea(const world::Rect& area, const world::Rect& seen, const world::Rect& later,
                                        const world::Camera& camera) {
  if (seen.empty() || later.empty()) return std::nullopt;
  const world::Rect wanted = withBorder(seen, later);
  const world::Rect both{std::min(area.left, wanted.left), std::min(area.top, wanted.top),
                         std::max(area.right, wanted.right), std::max(area.bottom, wanted.bottom)};
  for (const world::Rect& each : {both, wanted}) {
    if (isWithin(kMaxExtended, each, camera)) return each;
  }
  return std::nullopt;
}

std::vector<world::Rect> partsBeyond(const world::Rect& area, const world::Rect& other) {
  const world::Rect kept = world::overlap(area, other);
  if (kept.empty()) return {area};
  std::vector<world::Rect> parts{{area.left, area.top, area.right, kept.top},
                                 {area.left, kept.top, kept.left, kept.bottom},
                                 {kept.right, kept.top, area.right, kept.bottom},
                                 {area.left, kept.bottom, area.right, area.bottom}};
  std::erase_if(parts, [](const world::Rect& part) { return part.empty(); });
  return parts;
}

}  // namespace grove::node
