#include "objects/lightfield/frontend/sight.h"

#include <algorithm>

#include "objects/lightfield/common/object_view.h"

namespace grove::objects::lightfield {
namespace {

/// Metres per second.
constexpr float kStanding = 0.05F;

}  // namespace

Sight sightOf(const node::VisibleObject& object, const node::View& view, const node::SharedOf& shared,
              const FieldInfo& field) {
  const world::Transform& transform = object.object.transform;
  return {object, view, shared, field.parts(), glm::inverse(transform.matrix()), objectCamera(view.camera, transform)};
}

world::Vec3 Sight::heading() const {
  const auto self = std::ranges::find(view.players, view.viewer, &world::Player::id);
  if (self == view.players.end()) return world::Vec3(0.0F);
  const world::Vec3 velocity = glm::mat3(toObject) * self->velocity;
  const float speed = glm::length(velocity);
  return speed > kStanding ? velocity / speed : world::Vec3(0.0F);
}

bool isNotNow(const node::Payload& payload) {
  const auto* const failure = std::get_if<node::Failure>(&payload);
  return failure != nullptr && failure->notNow;
}

}  // namespace grove::objects::lightfield
