#include "objects/herd/frontend/herd_motion.h"

#include <cmath>

namespace grove::objects::herd {
namespace {

constexpr float kSlowest = 0.1F;  // metres per second
/// Metres; there, a step of a run between two pictures is a few pixels.
constexpr float kFurthest = 24.0F;
/// A herd whose newest tick is older stands still.
constexpr double kMostTicks = 2.0;

}  // namespace

std::optional<node::Mover> moverOf(const HerdSnapshot& herd, const Animal& animal, const world::Bounds& bounds,
                                   const node::View& view) {
  if (!(std::abs(view.time - herd.time()) * kTicksPerSecond <= kMostTicks)) return std::nullopt;
  const world::Vec3 velocity = (animal.now.place - animal.before.place) * static_cast<float>(kTicksPerSecond);
  if (glm::length(velocity) < kSlowest) return std::nullopt;
  const world::Camera& camera = view.camera;
  const float depth = camera.project(bounds.centre()).z;
  const float around = 0.5F * glm::length(world::Vec2(bounds.size().x, bounds.size().z));
  if (depth - around < camera.nearDepth || depth > kFurthest) return std::nullopt;
  const world::Rect rect = camera.screenRect(bounds);
  if (rect.empty()) return std::nullopt;
  return node::Mover{rect, depth - around, depth + around, velocity};
}

}  // namespace grove::objects::herd
