#include "world/camera.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace grove::world {
namespace {

/// Pairs of indices into Bounds::corners().
constexpr std::array<std::pair<std::size_t, std::size_t>, 12> kBoxEdges{
    {{0, 1}, {2, 3}, {4, 5}, {6, 7}, {0, 2}, {1, 3}, {4, 6}, {5, 7}, {0, 4}, {1, 5}, {2, 6}, {3, 7}}};

}  // namespace

Vec3 Pose::forward() const noexcept {
  return {-std::sin(yaw) * std::cos(pitch), std::sin(pitch), -std::cos(yaw) * std::cos(pitch)};
}

Vec3 Pose::right() const noexcept { return {std::cos(yaw), 0.0F, -std::sin(yaw)}; }

Vec3 Pose::up() const noexcept { return glm::cross(right(), forward()); }

float Camera::tanHalfY() const noexcept { return std::tan(verticalFov * 0.5F); }

float Camera::tanHalfX() const noexcept { return tanHalfY() * static_cast<float>(width) / static_cast<float>(height); }

float Camera::focal() const noexcept { return 0.5F * static_cast<float>(height) / tanHalfY(); }

Vec3 Camera::ray(float x, float y) const noexcept {
  const float u = (2.0F * x / static_cast<float>(width) - 1.0F) * tanHalfX();
  const float v = (1.0F - 2.0F * y / static_cast<float>(height)) * tanHalfY();
  return pose.forward() + u * pose.right() + v * pose.up();
}

Mat4 Camera::view() const { return glm::lookAt(pose.position, pose.position + pose.forward(), pose.up()); }

Mat4 Camera::projection() const {
  return glm::perspective(verticalFov, static_cast<float>(width) / static_cast<float>(height), nearDepth, farDepth);
}

Vec3 Camera::project(Vec3 point) const noexcept {
  const Vec3 d = point - pose.position;
  const float depth = glm::dot(d, pose.forward());
  const float scale = focal() / depth;
  return {0.5F * static_cast<float>(width) + glm::dot(d, pose.right()) * scale,
          0.5F * static_cast<float>(height) - glm::dot(d, pose.up()) * scale, depth};
}

bool Camera::sees(const Bounds& bounds) const noexcept {
  if (bounds.empty()) return false;
  const Vec3 f = pose.forward();
  const Vec3 x = pose.right();
  const Vec3 y = pose.up();
  const float tx = tanHalfX();
  const float ty = tanHalfY();
  const std::array<Vec4, 6> planes = {Vec4(f, nearDepth),      Vec4(-f, -farDepth),    Vec4(x + f * tx, 0.0F),
                                      Vec4(-x + f * tx, 0.0F), Vec4(y + f * ty, 0.0F), Vec4(-y + f * ty, 0.0F)};
  const Vec3 centre = bounds.centre() - pose.position;
  const Vec3 half = bounds.size() * 0.5F;
  return std::ranges::all_of(planes, [&](const Vec4& plane) {
    const Vec3 n(plane);
    return glm::dot(n, centre) + glm::dot(glm::abs(n), half) >= plane.w;
  });
}

Rect Camera::screenRect(const Bounds& bounds) const noexcept {
  if (bounds.empty()) return {};
  float left = 1e9F;
  float top = 1e9F;
  float right = -1e9F;
  float bottom = -1e9F;
  const auto add = [&](Vec3 point) {
    const Vec3 p = project(point);
    left = std::min(left, p.x);
    right = std::max(right, p.x);
    top = std::min(top, p.y);
    bottom = std::max(bottom, p.y);
  };
  // The box's part beyond the near plane has the corners there and the intersections of its edges with the plane.
  const std::array<Vec3, 8> corners = bounds.corners();
  std::array<float, 8> beyond;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    beyond[i] = glm::dot(corners[i] - pose.position, pose.forward()) - nearDepth;
    if (beyond[i] >= 0.0F) add(corners[i]);
  }
  for (const auto& [a, b] : kBoxEdges) {
    if ((beyond[a] < 0.0F) != (beyond[b] < 0.0F)) {
      add(glm::mix(corners[a], corners[b], beyond[a] / (beyond[a] - beyond[b])));
    }
  }
  if (left > right) return {};
  const auto clampTo = [](float value, int size) {
    return static_cast<int>(std::clamp(value, 0.0F, static_cast<float>(size)));
  };
  return {clampTo(std::floor(left), width), clampTo(std::floor(top), height), clampTo(std::ceil(right), width),
          clampTo(std::ceil(bottom), height)};
}

}  // namespace grove::world
