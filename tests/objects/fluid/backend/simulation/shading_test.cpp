#include "objects/fluid/backend/simulation/shading.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <numeric>

#include "world/sky.h"

namespace grove::objects::fluid {
namespace {

constexpr int kShadedCells = 32;
constexpr float kShadedSize = 4.0F;

/// A dense ball of smoke in the middle of the cube.
Particles puff(const SolidGrid& solids) {
  Particles particles({{2.0F, 2.0F, 2.0F}, 0.8F, 100'000.0F, 4.0F, 7.0F}, 3);
  particles.inject(solids, 0.1F, kShadedSize / kShadedCells);
  std::fill(particles.temperature.begin(), particles.temperature.end(), 0.0F);
  return particles;
}

/// Mean of `light` over particles whose place along `axis` is below or above the middle.
double mean(const Particles& particles, const std::vector<float>& light, world::Vec3 direction, bool ahead) {
  double sum = 0.0;
  int count = 0;
  for (std::size_t i = 0; i < particles.count(); ++i) {
    const world::Vec3 place(particles.x[i] - 2.0F, particles.y[i] - 2.0F, particles.z[i] - 2.0F);
    if ((glm::dot(place, direction) > 0.0F) != ahead) continue;
    sum += static_cast<double>(light[i]);
    ++count;
  }
  return sum / count;
}

TEST(Shading, IsDarkerBelowAndAwayFromTheSun) {
  const SolidGrid solids(Layout(kShadedCells), Sides::outdoors());
  const Particles particles = puff(solids);
  for (const world::Vec3 sun : {world::Sky().sun, glm::normalize(world::Vec3(-0.3F, 0.2F, -0.9F)),
                                glm::normalize(world::Vec3(0.9F, 0.1F, -0.1F))}) {
    Shading shading(kShadedCells, kShadedSize, sun, {});
    std::vector<float> sky;
    std::vector<float> light;
    shading.shade(particles, solids, sky, light);
    ASSERT_EQ(sky.size(), particles.count());
    EXPECT_LT(mean(particles, sky, {0.0F, 1.0F, 0.0F}, false), 0.8 * mean(particles, sky, {0.0F, 1.0F, 0.0F}, true));
    EXPECT_LT(mean(particles, light, sun, false), 0.8 * mean(particles, light, sun, true));
  }
}

TEST(Shading, SingleParticleIsFullyLit) {
  const SolidGrid solids(Layout(kShadedCells), Sides::outdoors());
  Particles particles({{2.0F, 2.0F, 2.0F}, 0.1F, 10.0F, 4.0F, 7.0F}, 3);
  particles.inject(solids, 0.1F, kShadedSize / kShadedCells);
  ASSERT_EQ(particles.count(), 1U);
  Shading shading(kShadedCells, kShadedSize, world::Sky().sun, {});
  std::vector<float> sky;
  std::vector<float> light;
  shading.shade(particles, solids, sky, light);
  EXPECT_GT(sky[0], 0.97F);
  EXPECT_GT(light[0], 0.97F);
}

TEST(Shading, SolidsAndTheWorldHideTheSun) {
  SolidGrid solids(Layout(kShadedCells), Sides::outdoors());
  const Particles particles = puff(solids);
  std::vector<float> sky;
  std::vector<float> open;
  std::vector<float> hidden;
  const world::Vec3 sun(1.0F, 0.0F, 0.0F);
  Shading(kShadedCells, kShadedSize, sun, {}).shade(particles, solids, sky, open);
  std::vector<std::uint8_t> wall(kShadedCells * kShadedCells * kShadedCells, 0);
  for (int z = 0; z < kShadedCells; ++z) {
    for (int y = 0; y < kShadedCells; ++y) {
      const std::ptrdiff_t row = std::ptrdiff_t{kShadedCells} * (kShadedCells * z + y);
      std::fill_n(wall.begin() + row + 26, 4, std::uint8_t{1});
    }
  }
  solids.setStatic(wall);
  Shading(kShadedCells, kShadedSize, sun, {}).shade(particles, solids, sky, hidden);
  EXPECT_GT(std::accumulate(open.begin(), open.end(), 0.0F), 100.0F);
  EXPECT_EQ(std::accumulate(hidden.begin(), hidden.end(), 0.0F), 0.0F);

  const int coarse = Shading::coarseCells(kShadedCells);
  Shading shaded(kShadedCells, kShadedSize, sun,
                 std::vector<float>(static_cast<std::size_t>(coarse * coarse * coarse), 0.0F));
  shaded.shade(particles, solids, sky, hidden);
  EXPECT_EQ(std::accumulate(hidden.begin(), hidden.end(), 0.0F), 0.0F);
}

}  // namespace
}  // namespace grove::objects::fluid
