#include "world/scenes/scene_hills.h"

#include <algorithm>
#include <cmath>

namespace grove::world {
namespace {

constexpr double kMinRadius = 0.5;
constexpr double kMaxRadius = 200.0;
constexpr int kProbes = 8;  ///< along a hill's radius

Vec2 placeOf(Vec3 position) { return {position.x, position.z}; }

}  // namespace

Hill readHill(const Parameters& parameters) {
  Hill hill;
  hill.centre = placeOf(parameters.vector("position", Vec3(0.0F)));
  hill.radius = static_cast<float>(parameters.number("radius", 10.0, kMinRadius, kMaxRadius));
  hill.height = static_cast<float>(parameters.number("height", 1.0, 0.0, double{kMaxGroundHeight}));
  parameters.finish();
  return hill;
}

bool areLowEnough(const std::vector<Hill>& hills) {
  return std::ranges::all_of(hills, [&](const Hill& hill) {
    for (int z = -kProbes; z <= kProbes; ++z) {
      for (int x = -kProbes; x <= kProbes; ++x) {
        const Vec2 place = hill.centre + Vec2(x, z) * (hill.radius / static_cast<float>(kProbes));
        if (groundHeight(hills, place) > kMaxGroundHeight) return false;
      }
    }
    return true;
  });
}

void standOnGround(Scene& scene) {
  const auto heightAt = [&](Vec3 position) { return groundHeight(scene.hills, placeOf(position)); };
  for (ObjectDescription& object : scene.objects) {
    Transform& transform = object.transform;
    transform.slope = groundSlope(scene.hills, placeOf(transform.position));
    transform.position.y += heightAt(transform.position);
  }
  for (LightDescription& light : scene.lights) light.position.y += heightAt(light.position);
  scene.spawn.y += heightAt(scene.spawn);
}

}  // namespace grove::world
