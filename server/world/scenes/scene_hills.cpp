#include "world/scenes/scene_hills.h"

#include <cmath>
#include <limits>
#include <sstream>
#include <string_view>

namespace grove::world {
namespace {

constexpr double kMinRadius = 0.5;
constexpr double kMaxRadius = 200.0;
constexpr double kMaxHeight = 1.6;
static_assert(static_cast<float>(kMaxHeight) == kMaxGroundHeight);

constexpr int kProbes = 8;                 ///< along a hill's radius
constexpr float kRoundingError = 1.0e-5F;  ///< metres, of the sum of hills

Vec2 placeOf(Vec3 position) { return {position.x, position.z}; }

float required(const Parameters& parameters, std::string_view key, double low, double high) {
  const double value = parameters.number(key, std::numeric_limits<double>::quiet_NaN(), low, high);
  if (std::isnan(value)) {
    std::ostringstream reason;
    reason << "'" << key << "' is missing; it must lie between " << low << " and " << high;
    parameters.fail(key, reason.str());
  }
  return static_cast<float>(value);
}

bool isTooHigh(std::span<const Hill> hills, const Hill& hill) {
  for (int z = -kProbes; z <= kProbes; ++z) {
    for (int x = -kProbes; x <= kProbes; ++x) {
      const Vec2 place = hill.centre + Vec2(x, z) * (hill.radius / static_cast<float>(kProbes));
      if (groundHeight(hills, place) > kMaxGroundHeight + kRoundingError) return true;
    }
  }
  return false;
}

}  // namespace

Hill readHill(const Parameters& parameters) {
  const Vec3 position = parameters.vector("position", Vec3(0.0F));
  if (position.y != 0.0F)
    parameters.fail("position", "'position' must have y = 0: hills rise from there by their height");
  const Hill hill{placeOf(position), required(parameters, "radius", kMinRadius, kMaxRadius),
                  required(parameters, "height", 0.0, kMaxHeight)};
  parameters.finish();
  return hill;
}

std::optional<std::size_t> tooHighHill(std::span<const Hill> hills) {
  for (std::size_t i = 0; i < hills.size(); ++i) {
    if (isTooHigh(hills, hills[i])) return i;
  }
  return std::nullopt;
}

void standOnGround(Scene& scene) {
  const auto heightAt = [&](Vec3 position) { return groundHeight(scene.hills, placeOf(position)); };
  for (ObjectDescription& object : scene.objects) {
    if (object.type == "ground" || object.type == "sky") continue;
    Transform& transform = object.transform;
    if (object.type != "fluid") transform.slope = groundSlope(scene.hills, placeOf(transform.position));
    transform.position.y += heightAt(transform.position);
  }
  for (LightDescription& light : scene.lights) light.position.y += heightAt(light.position);
  scene.spawn.y += heightAt(scene.spawn);
}

}  // namespace grove::world
