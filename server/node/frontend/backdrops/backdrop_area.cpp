#include "node/frontend/backdrops/backdrop_area.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "node/frontend/backdrops/warp_camera.h"

namespace grove::node {
namespace {

/// Border beyond what is expected to be seen: a share of that, and pixels, even.
constexpr float kSpareShare = 1.15F;
constexpr int kSpare = 2;
/// Pixels of an area, in multiples of the frame's.
constexpr float kMaxGrowth = 1.3F;

/// Pixels, of rays that are almost parallel to the backdrop.
constexpr float kFarOut = 1.0e6F;

/// Grows towards larger magnitudes, for areas have even edges.
int evenUp(float value) { return 2 * static_cast<int>(std::ceil(0.5F * value)); }
int evenDown(float value) { return 2 * static_cast<int>(std::floor(0.5F * value)); }

float pixelsOf(const world::Rect& rect) { return static_cast<float>(rect.width()) * static_cast<float>(rect.height()); }

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

std::optional<world::Rect> areaWithBorder(const world::Camera& camera, const world::Camera& later, float nearest) {
  const world::Rect frame = evenFrame(camera);
  const world::Rect seen = seenPart(camera, later, nearest);
  if (seen.empty()) return std::nullopt;
  const auto border = [](int beyond) {
    return beyond > 0 ? evenUp(kSpareShare * static_cast<float>(beyond)) + kSpare : 0;
  };
  const world::Rect area{frame.left - border(frame.left - seen.left), frame.top - border(frame.top - seen.top),
                         frame.right + border(seen.right - frame.right),
                         frame.bottom + border(seen.bottom - frame.bottom)};
  if (pixelsOf(area) > kMaxGrowth * pixelsOf(frame)) return std::nullopt;
  return area;
}

world::Rect evenFrame(const world::Camera& camera) {
  return {0, 0, camera.width + camera.width % 2, camera.height + camera.height % 2};
}

}  // namespace grove::node
