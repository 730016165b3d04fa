#include "objects/lightfield/format/light_field.h"

#include <cmath>
#include <glm/gtc/constants.hpp>

namespace grove::objects::lightfield {

int LightField::lightingFor(float yaw, world::Vec3 sun) const noexcept {
  // Rotating an object by yaw rotates the sun by -yaw relative to it.
  const float azimuth = std::atan2(sun.x, sun.z) - yaw - sunAzimuth;
  const float steps = azimuth / glm::two_pi<float>() * static_cast<float>(lightings());
  const int nearest = static_cast<int>(std::lround(steps)) % lightings();
  return nearest < 0 ? nearest + lightings() : nearest;
}

}  // namespace grove::objects::lightfield
