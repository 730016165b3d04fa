#include "objects/fluid/backend/simulation/particles.h"

#include <gtest/gtest.h>

#include <vector>

namespace grove::objects::fluid {
namespace {

constexpr int kBoxCells = 16;
constexpr float kCell = 0.25F;
constexpr float kStep = 1.0F / 30.0F;

TEST(Particles, RateAndLifetimeHold) {
  const Layout layout(kBoxCells);
  const SolidGrid solids(layout, Sides::outdoors());
  const Velocity still(layout);
  Particles particles({{2.0F, 1.0F, 2.0F}, 0.3F, 500.0F, 1.0F, 2.0F}, 1);
  for (int i = 0; i < 30; ++i) {
    particles.inject(solids, kStep, kCell);
    EXPECT_EQ(particles.count(), particles.injected()) << "none is old yet";
    particles.advance(solids, still, kStep, kCell);
  }
  EXPECT_NEAR(static_cast<double>(particles.injected()), 500.0, 1.0);
  for (int i = 0; i < 62; ++i) particles.advance(solids, still, kStep, kCell);
  EXPECT_EQ(particles.count(), 0U);
}

TEST(Particles, AreBounded) {
  const Layout layout(kBoxCells);
  const SolidGrid solids(layout, Sides::outdoors());
  Particles particles({{2.0F, 1.0F, 2.0F}, 0.3F, 1.0e6F, 4.0F, 7.0F}, 1);
  particles.inject(solids, 1.0F, kCell);
  particles.inject(solids, 1.0F, kCell);
  EXPECT_EQ(particles.count(), Particles::kMax);
}

TEST(Particles, KeepTheirOrder) {
  const Layout layout(kBoxCells);
  const SolidGrid solids(layout, Sides::outdoors());
  const Velocity still(layout);
  Particles particles({{2.0F, 1.0F, 2.0F}, 0.3F, 300.0F, 0.5F, 3.0F}, 1);
  particles.inject(solids, 1.0F, kCell);
  const std::vector<float> before = particles.x;
  for (int i = 0; i < 30; ++i) particles.advance(solids, still, kStep, kCell);
  ASSERT_LT(particles.count(), before.size());
  ASSERT_GT(particles.count(), 0U);
  std::size_t at = 0;
  for (const float x : particles.x) {
    while (at < before.size() && std::abs(before[at] - x) > 1.0e-5F) ++at;
    ASSERT_LT(at, before.size()) << "not in the old order";
    ++at;
  }
}

TEST(Particles, NeverEnterSolids) {
  const Layout layout(kBoxCells);
  SolidGrid solids(layout, Sides::outdoors());
  std::vector<std::uint8_t> wall(kBoxCells * kBoxCells * kBoxCells, 0);
  for (int z = 0; z < kBoxCells; ++z) {
    for (int y = 0; y < kBoxCells; ++y) wall[static_cast<std::size_t>((z * kBoxCells + y) * kBoxCells + 11)] = 1;
  }
  solids.setStatic(wall);
  Velocity wind(layout);
  for (std::size_t i = 0; i < layout.size(); ++i) wind.x[static_cast<std::ptrdiff_t>(i)] = 40.0F;
  Particles particles({{2.0F, 2.0F, 2.0F}, 0.5F, 3000.0F, 4.0F, 7.0F}, 1);
  particles.inject(solids, 0.3F, kCell);
  const std::size_t count = particles.count();
  for (int i = 0; i < 20; ++i) particles.advance(solids, wind, kStep, kCell);
  EXPECT_EQ(particles.count(), count);
  for (const float x : particles.x) ASSERT_LT(x, 11.0F * kCell);
}

TEST(Particles, MovingSolidsPushThem) {
  const Layout layout(kBoxCells);
  SolidGrid solids(layout, Sides::outdoors());
  const Velocity still(layout);
  Particles particles({{2.0F, 1.0F, 2.0F}, 0.2F, 3000.0F, 4.0F, 7.0F}, 1);
  particles.inject(solids, 0.1F, kCell);
  for (int i = 0; i < 20; ++i) {
    const Capsule capsule{{1.0F + 0.05F * static_cast<float>(i), 0.0F, 2.0F}, 1.8F, 0.4F, {1.5F, 0.0F, 0.0F}};
    solids.setMovers({&capsule, 1}, kCell);
    particles.advance(solids, still, kStep, kCell);
    for (std::size_t k = 0; k < particles.count(); ++k) {
      const std::ptrdiff_t cell =
          layout.index(static_cast<int>(particles.x[k] / kCell), static_cast<int>(particles.y[k] / kCell),
                       static_cast<int>(particles.z[k] / kCell));
      ASSERT_NE(solids.air()[cell], 0);
    }
  }
  EXPECT_GT(particles.count(), 200U);
}

}  // namespace
}  // namespace grove::objects::fluid
