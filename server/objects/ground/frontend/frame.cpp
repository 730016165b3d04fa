#include "objects/ground/frontend/frame.h"

#include <algorithm>
#include <cmath>

namespace grove::objects::ground {

Frame frameOf(const world::Camera& camera) {
  const float sine = std::sin(camera.pose.pitch);
  const float cosine = std::cos(camera.pose.pitch);
  const float vStep = -2.0F * camera.tanHalfY() / static_cast<float>(camera.height);
  const float v0 = camera.tanHalfY() + 0.5F * vStep;
  const float yaw = camera.pose.yaw;
  Frame frame;
  frame.eyeX = camera.pose.position.x;
  frame.eyeY = camera.pose.position.y;
  frame.eyeZ = camera.pose.position.z;
  frame.forwardX = -std::sin(yaw);
  frame.forwardZ = -std::cos(yaw);
  frame.sideX = std::cos(yaw);
  frame.sideZ = -std::sin(yaw);
  frame.sideStep = 2.0F * camera.tanHalfX() / static_cast<float>(camera.width);
  frame.firstSide = 0.5F * frame.sideStep - camera.tanHalfX();
  frame.firstInverse = -(sine + v0 * cosine) / frame.eyeY;
  frame.inverseStep = -vStep * cosine / frame.eyeY;
  frame.firstAhead = cosine - v0 * sine;
  frame.aheadStep = -vStep * sine;
  frame.focal = camera.focal();
  return frame;
}

Row rowAt(const Frame& frame, int row) noexcept {
  const auto at = static_cast<float>(row);
  const float inverse = std::max(0.8F / kFarthest, frame.firstInverse + at * frame.inverseStep);
  const float ahead = frame.firstAhead + at * frame.aheadStep;
  const float depth = 1.0F / inverse;
  const float flat = std::max(0.05F, std::fabs(ahead));
  return {row,
          depth,
          ahead,
          -frame.eyeY * inverse,
          std::max(0.0F, frame.focal * ahead * inverse),
          depth * frame.sideStep,
          depth * depth * frame.inverseStep * flat};
}

}  // namespace grove::objects::ground
