#include "world/world.h"

#include <cmath>
#include <utility>

#include "pipeline/clocks.h"

namespace grove::world {
namespace {

constexpr float kLanternRadiance = 0.45F;

std::vector<Obstacle> gatherObstacles(const std::vector<Object>& objects) {
  std::vector<Obstacle> all;
  for (const Object& object : objects) {
    if (const auto radius = object.model->obstacleRadius()) {
      const Vec3 at = object.transform.position;
      all.push_back({{at.x, at.z}, *radius * object.transform.scale});
    }
  }
  return all;
}

}  // namespace

World::World(Layout layout, std::shared_ptr<const WorldGeometry> geometry, std::shared_ptr<Players> players)
    : layout_(std::move(layout)),
      geometry_(geometry ? std::move(geometry) : std::make_shared<const WorldGeometry>(layout_.objects)),
      players_(players ? std::move(players) : makePlayers(layout_)) {}

std::shared_ptr<Players> World::makePlayers(const Layout& layout) {
  return std::make_shared<Players>(layout.spawn, layout.spawnYaw, layout.radius, gatherObstacles(layout.objects));
}

std::optional<Object> World::objectOf(const Player& player) const {
  if (!layout_.visitor) return std::nullopt;
  Object object = *layout_.visitor;
  object.id = kFirstPlayerObject + player.id;
  object.name = player.name;
  object.transform.position = player.pose.position - Vec3(0, kEyeHeight, 0);
  object.transform.yaw = player.pose.yaw;
  object.bounds = object.transform.apply(object.model->bounds());
  return object;
}

std::vector<PointLight> World::lights(double now, const std::vector<Player>& players) const {
  std::vector<PointLight> all;
  all.reserve(layout_.lights.size() + players.size());
  for (const FlickeringLight& flickering : layout_.lights) {
    PointLight light = flickering.light;
    // Frequencies without a common period never repeat visibly.
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

double World::now() noexcept { return static_cast<double>(pipeline::wallNanoseconds()) * 1e-9; }

}  // namespace grove::world
