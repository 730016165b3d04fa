#include "objects/figure/frontend/figure_motion.h"

#include "objects/figure/common/stature.h"

namespace grove::objects::figure {
namespace {

/// From the figure's axis to a hand or a foot that swings. Metres.
constexpr float kReach = 0.45F;
constexpr float kSlowest = 0.1F;   // metres per second
constexpr float kFurthest = 16.0F;  // metres; there, a step of a walk between two pictures is two pixels

}  // namespace

std::optional<node::Mover> moverOf(const world::Object& object, const world::Player& player,
                                   const world::Camera& camera) {
  if (glm::length(player.velocity) < kSlowest) return std::nullopt;
  const float scale = scaleOf(object);
  const world::Vec3 feet = object.transform.position;
  const world::Vec3 reach(kReach * scale, 0.0F, kReach * scale);
  const world::Vec3 top(0.0F, kFigureHeight * scale, 0.0F);
  const float depth = camera.project(feet + 0.5F * top).z;
  const float nearest = depth - reach.x;
  if (nearest < camera.nearDepth || depth > kFurthest) return std::nullopt;
  const world::Rect rect = camera.screenRect({feet - reach, feet + top + reach});
  if (rect.empty()) return std::nullopt;
  return node::Mover{rect, nearest, depth + reach.x, player.velocity};
}

}  // namespace grove::objects::figure
