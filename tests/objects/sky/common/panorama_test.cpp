#include "objects/sky/common/panorama.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "objects/sky/backend/panorama_bake.h"
#include "objects/sky/common/ramps.h"
#include "world/sky.h"

namespace grove::objects::sky {
namespace {

TEST(Panorama, TexelDirectionsRoundTrip) {
  const Panorama panorama = ramps();
  for (const int column : {0, 1, 63, 64, 127, 200, 255}) {
    for (const int row : {0, 5, 40, 100, 120}) {
      const auto direction = Panorama::direction(panorama.heading(column), panorama.tangent(row));
      const auto found = panorama.sample(direction);
      const auto texel = panorama.texel(column, row);
      EXPECT_NEAR(found.r, static_cast<float>(texel & 0xFFU), 0.1F) << column << ", " << row;
      EXPECT_NEAR(found.g, static_cast<float>((texel >> 8U) & 0xFFU), 0.1F) << column << ", " << row;
    }
  }
}

TEST(Panorama, HeadingsTurnClockwiseFromMinusZ) {
  const auto east = Panorama::direction(std::numbers::pi_v<float> / 2.0F, 0.0F);
  EXPECT_NEAR(east.x, 1.0F, 1e-5F);
  EXPECT_NEAR(east.z, 0.0F, 1e-5F);
}

TEST(Panorama, SoftMapMatchesTheSharpOne) {
  const SkyMaps maps(bakePanorama({1024, 256}, 7, world::Sky(), [](float) {}));
  EXPECT_EQ(maps.soft.width() * kSoftColumns, maps.sharp.width());
  EXPECT_EQ(maps.soft.height() * kSoftRows, maps.sharp.height());
  double square = 0.0;
  int count = 0;
  for (int step = 0; step < 126; ++step) {
    const float heading = 0.01F + 0.05F * static_cast<float>(step);
    for (const float tangent : {0.2F, 0.5F, 1.0F, 3.0F}) {
      const world::Vec3 direction = Panorama::direction(heading, tangent);
      if (glm::dot(direction, world::Sky().sun) > 0.999F) continue;
      const world::Vec3 off = maps.soft.sample(direction) - maps.sharp.sample(direction);
      square += static_cast<double>(glm::dot(off, off)) / 3.0;
      ++count;
    }
  }
  EXPECT_LT(std::sqrt(square / count), 2.0);
}

TEST(PanoramaBake, HasNoSeamAndIsBrightestAtTheSun) {
  float reported = 0.0F;
  const Panorama panorama = bakePanorama({512, 128}, 7, world::Sky(), [&](float share) {
    EXPECT_GE(share, reported);
    reported = share;
  });
  EXPECT_FLOAT_EQ(reported, 1.0F);
  // From the last column to the first is no bigger a step than between any two.
  for (int row = 40; row < 128; ++row) {
    const auto green = [&](int column) { return static_cast<int>((panorama.texel(column, row) >> 8U) & 0xFFU); };
    EXPECT_LE(std::abs(green(511) - green(0)), 24) << row;
  }
  const auto sun = panorama.sample(world::Sky().sun);
  const auto opposite = panorama.sample(world::Sky().sun * world::Vec3(-1, 1, -1));
  EXPECT_GT(sun.r, 245.0F);
  EXPECT_GT(sun.r, opposite.r + 20.0F);
}

}  // namespace
}  // namespace grove::objects::sky
