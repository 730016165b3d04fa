#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <thread>
#include <vector>

#include "measure/pictures/picture_quality.h"
#include "models/plants/plants.h"
#include "objects/lightfield/backend/near/near_renderer.h"
#include "objects/lightfield/bake/light/lightings.h"
#include "objects/lightfield/bake/near/near_surface.h"
#include "objects/lightfield/bake/refine.h"
#include "objects/lightfield/bake/view_renderer.h"
#include "sanitized.h"

namespace grove::bake {
namespace {

using objects::lightfield::ObjectCamera;
using world::Vec3;

constexpr int kSize = 256;

/// A camera at `eye` that looks at `at`, 60 degrees wide.
ObjectCamera lookAt(Vec3 eye, Vec3 at) {
  const Vec3 forward = glm::normalize(at - eye);
  const Vec3 right = glm::normalize(glm::cross(forward, Vec3(0, 1, 0)));
  const Vec3 down = glm::cross(forward, right);
  const float width = 2.0F * std::tan(0.5236F);
  ObjectCamera camera;
  camera.eye = eye;
  camera.perColumn = right * (width / kSize);
  camera.perRow = down * (width / kSize);
  camera.corner = forward - 0.5F * width * (right + down);
  return camera;
}

/// A picture over a sky, as visitors see it.
std::vector<std::uint32_t> overSky(const std::uint32_t* colours) {
  constexpr std::array<std::uint32_t, 3> kSky{180, 190, 210};
  std::vector<std::uint32_t> result;
  for (std::size_t i = 0; i < std::size_t{kSize} * kSize; ++i) {
    std::uint32_t mixed = 0xFF000000U;
    for (unsigned c = 0; c < 3; ++c) {
      mixed |= (((colours[i] >> (8U * c)) & 0xFFU) + kSky[c] * (255U - (colours[i] >> 24U)) / 255U) << (8U * c);
    }
    result.push_back(mixed);
  }
  return result;
}

/// Fails if triangles have another place, light or edge than rays find. The rays see the same model in the same light:
/// 36 of them per pixel. Measured: 30.4 to 36.2 dB.
TEST(NearTruth, TreesFromNearAreWhatRaysSee) {
  for (const char* const plant : kSanitized ? std::vector{"spruce"} : std::vector{"oak", "birch", "spruce"}) {
    const models::Model model =
        refined(models::makePlant(plant, 1, models::Detail::kSmall), {.solid = 0.12F, .leaves = 0.32F});
    const std::vector<TextureSampler> textures;
    const ModelRays rays(model, textures);
    const LightPoints points = chooseLightPoints(model, textures, 0.16F, PointsOf::kCell);
    const LightSettings settings{
        .threads = static_cast<int>(std::thread::hardware_concurrency()), .directions = 8, .sunRays = 2};
    const SurfaceLight light =
        lightSurfaces(model, points, rays, Lightings(world::Sky{}, 1), settings, [](float) {}, {});
    const ViewRenderer truth(model, textures, rays, points, light, kSanitized ? 4 : 6);
    const NearSurface surface = makeNearSurface(model, points, light);
    pipeline::MemoryLedger memory;
    objects::lightfield::NearRenderer renderer(memory);
    raster::ImagePool images;
    // Half a metre to six metres from the trunk, level and looking up.
    const std::array eyes{std::pair{Vec3(0.6F, 1.6F, 0.2F), Vec3(0, 6, 0)},
                          std::pair{Vec3(1.5F, 1.6F, 1), Vec3(0, 2, 0)}, std::pair{Vec3(-2, 1.6F, 2.5F), Vec3(0, 5, 0)},
                          std::pair{Vec3(4, 1.6F, -4.4F), Vec3(0, 2.5F, 0)}};
    for (const auto& [eye, at] : std::span(eyes).first(kSanitized ? 1 : eyes.size())) {
      const ObjectCamera camera = lookAt(eye, at);
      const auto image = renderer.render(surface.model(), 0, camera, {}, {0, 0, kSize, kSize}, images);
      ASSERT_EQ(image->width(), kSize) << "the tree fills the picture";
      const Picture expected = truth.render(camera, kSize);
      const auto shown = overSky(image->colour.data());
      const auto drawn = overSky(expected.colour.front().data());
      const double error = measure::meanSquareError({shown, kSize}, {drawn, kSize}, measure::Mask(shown.size(), 1));
      EXPECT_GE(measure::decibels(error), 29.5) << plant << " from " << eye.x << ", " << eye.z;
    }
  }
}

}  // namespace
}  // namespace grove::bake
