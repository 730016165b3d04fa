#pragma once

#include <algorithm>
#include <optional>

#include "world/geometry.h"

namespace grove::world {

/// Pixels, origin at the top left; `right` and `bottom` are exclusive.
struct Rect {
  int left = 0;
  int top = 0;
  int right = 0;
  int bottom = 0;

  [[nodiscard]] int width() const noexcept { return right - left; }
  [[nodiscard]] int height() const noexcept { return bottom - top; }
  [[nodiscard]] bool empty() const noexcept { return right <= left || bottom <= top; }
  [[nodiscard]] Rect moved(int across, int down) const noexcept {
    return {left + across, top + down, right + across, bottom + down};
  }
  friend bool operator==(const Rect&, const Rect&) = default;
};

/// Empty if they do not overlap.
[[nodiscard]] constexpr Rect overlap(const Rect& a, const Rect& b) noexcept {
  return {std::max(a.left, b.left), std::max(a.top, b.top), std::min(a.right, b.right), std::min(a.bottom, b.bottom)};
}

/// Position and direction of an eye. Yaw 0 looks along -Z and grows counter-clockwise seen from above; pitch grows
/// upwards.
struct Pose {
  Vec3 position{0.0F, 1.7F, 0.0F};
  float yaw = 0.0F;    ///< radians
  float pitch = 0.0F;  ///< radians, within +-kMaxPitch

  [[nodiscard]] Vec3 forward() const noexcept;
  [[nodiscard]] Vec3 right() const noexcept;
  [[nodiscard]] Vec3 up() const noexcept;
  friend bool operator==(const Pose&, const Pose&) = default;
};

inline constexpr float kMaxPitch = 1.5F;

/// A pinhole camera for an image of width x height pixels. Depth everywhere in Grove is *view depth*: metres along
/// forward(), so that a pixel's point is `position + depth * ray(pixel)`.
struct Camera {
  Pose pose;
  int width = 1280;
  int height = 720;
  float verticalFov = 1.05F;  ///< radians
  float nearDepth = 0.1F;     ///< metres
  float farDepth = 1000.0F;   ///< metres

  [[nodiscard]] float tanHalfY() const noexcept;
  [[nodiscard]] float tanHalfX() const noexcept;
  /// Focal length in pixels.
  [[nodiscard]] float focal() const noexcept;
  /// Ray through a point of the image (pixel centres are at +0.5), scaled to advance one metre of view depth.
  [[nodiscard]] Vec3 ray(float x, float y) const noexcept;
  [[nodiscard]] Mat4 view() const;
  [[nodiscard]] Mat4 projection() const;
  /// x and y in pixels, z is view depth; x and y are undefined if z <= 0.
  [[nodiscard]] Vec3 project(Vec3 point) const noexcept;
  /// False only if the box is certainly outside the view.
  [[nodiscard]] bool sees(const Bounds& bounds) const noexcept;
  /// The smallest rectangle of pixels around the box's part beyond the near plane, clipped to the image.
  [[nodiscard]] Rect screenRect(const Bounds& bounds) const noexcept;
  friend bool operator==(const Camera&, const Camera&) = default;
};

/// View depth of pixels without a surface, the sky's.
inline constexpr float kInfiniteDepth = 1.0e30F;

}  // namespace grove::world
