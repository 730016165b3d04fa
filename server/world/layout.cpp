#include "world/layout.h"

#include <cmath>

#include "world/ground/ground_shadow.h"

namespace grove::world {
namespace {

constexpr float kLanternRadiance = 0.45F;

}  // namespace

std::vector<Obstacle> Layout::obstacles() const {
  std::vector<Obstacle> obstacles;
  for (const Object& object : objects) {
    const Vec3 at = object.transform.position;
    if (object.obstacleRadius > 0.0F) obstacles.push_back({{at.x, at.z}, object.obstacleRadius});
  }
  return obstacles;
}

std::optional<Object> Layout::objectOf(const Player& player) const {
  if (!visitor) return std::nullopt;
  Object object = visitor->object;
  object.id = kFirstPlayerObject + player.id;
  object.name = player.name;
  object.transform.position = player.pose.position - Vec3(0, kEyeHeight, 0);
  object.transform.yaw = player.pose.yaw;
  object.bounds = object.transform.apply(visitor->bounds);
  if (visitor->castsShadow) object.bounds.add(shadowBounds(object.bounds, sky.sun));
  return object;
}

std::optional<Object> Layout::shadowOf(const Player& player) const {
  std::optional<Object> object = objectOf(player);
  if (!object || !visitor->castsShadow) return std::nullopt;
  object->bounds = shadowBounds(object->transform.apply(visitor->bounds), sky.sun);
  return object;
}

std::vector<PointLight> Layout::lightsAt(double now, const std::vector<Player>& players) const {
  std::vector<PointLight> all;
  all.reserve(lights.size() + players.size());
  for (const FlickeringLight& flickering : lights) {
    PointLight light = flickering.light;
    // Frequencies without a common period: no visible repetition.
    const auto t = static_cast<float>(std::fmod(now, 3600.0));
    const float wave =
        0.45F * std::sin(9.1F * t) + 0.3F * std::sin(14.7F * t + 1.3F) + 0.25F * std::sin(23.9F * t + 0.7F);
    light.colour *= 1.0F + 0.5F * flickering.flicker * wave;
    light.position.y += 0.06F * flickering.flicker * wave;
    all.push_back(light);
  }
  for (const Player& player : players) {
    const auto channel = [&](unsigned shift) { return static_cast<float>(player.colour >> shift & 0xFFU) / 255.0F; };
    const Vec3 held = player.pose.position + 0.35F * player.pose.right() +
                      Vec3(-0.3F * std::sin(player.pose.yaw), -0.7F, -0.3F * std::cos(player.pose.yaw));
    all.push_back({held, kLanternRadiance * Vec3(channel(0), channel(8), channel(16))});
  }
  return all;
}

}  // namespace grove::world
