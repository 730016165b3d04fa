#include "objects/lightfield/format/light_field.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "world/sky.h"

namespace grove::objects::lightfield {
namespace {

/// For every turn, the sun of the chosen lighting, turned with the object, stands no further from the world's sun than
/// half a step, and no other lighting's stands nearer.
TEST(LightField, ChoosesTheLightingNearestToTheSun) {
  LightField field;
  field.sunAzimuth = 0.7F;
  for (const std::size_t lightings : {1U, 2U, 6U, 16U}) {
    field.colour.resize(lightings);
    const world::Vec3 sun = world::Sky().sun;
    const world::Vec3 flat = glm::normalize(world::Vec3(sun.x, 0.0F, sun.z));
    for (int turn = 0; turn < 568; ++turn) {
      const float yaw = -9.0F + 0.0317F * static_cast<float>(turn);
      const auto agreement = [&](int lighting) {
        const float step = 2.0F * std::numbers::pi_v<float> / static_cast<float>(lightings);
        const float azimuth = field.sunAzimuth + static_cast<float>(lighting) * step;
        const world::Vec4 turned = world::Transform{world::Vec3(0.0F), yaw, 1.0F}.matrix() *
                                   world::Vec4(std::sin(azimuth), 0.0F, std::cos(azimuth), 0.0F);
        return glm::dot(world::Vec3(turned), flat);
      };
      const int chosen = field.lightingFor(yaw, world::Sky().sun);
      ASSERT_GE(chosen, 0);
      ASSERT_LT(chosen, field.lightings());
      for (int other = 0; other < field.lightings(); ++other)
        ASSERT_GE(agreement(chosen), agreement(other) - 1e-4F) << yaw;
    }
  }
}

}  // namespace
}  // namespace grove::objects::lightfield
