#include <cmath>

#include "objects/fluid/frontend/curls/smoke_curls_kernels.h"

namespace grove::objects::fluid {
namespace {

/// Width of the finest detail in pixels of the frame. The same for all scales of the target, so that a change of scale
/// does not show.
constexpr float kFinestPixels = 3.0F;

}  // namespace

CurlLens::CurlLens(const world::Camera& camera, const SmokePixels& pixels, double seconds, world::Vec3 towardsSun)
    : eye(camera.pose.position),
      finest(kFinestPixels / camera.focal()),
      risen(static_cast<float>(std::fmod(static_cast<double>(kCurlPace) * seconds, kCurlRepeat))),
      sun(towardsSun) {
  const auto scale = static_cast<float>(pixels.scale);
  const auto rayAt = [&](int x, int y) {
    return camera.ray(scale * (static_cast<float>(pixels.rect.left + x) + 0.5F),
                      scale * (static_cast<float>(pixels.rect.top + y) + 0.5F));
  };
  corner = rayAt(0, 0);
  right = rayAt(1, 0) - corner;
  down = rayAt(0, 1) - corner;
}

}  // namespace grove::objects::fluid
