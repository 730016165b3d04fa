#include "objects/fluid/backend/simulation/particles_kernels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "each_target.h"
#include "objects/fluid/backend/simulation/particle_obstacles.h"

namespace grove::objects::fluid {
namespace {

constexpr int kCrowdCells = 24;
constexpr float kCrowdCell = 0.25F;
constexpr float kCrowdStep = 1.0F / 30.0F;
constexpr float kNewest = 5.5F;

struct Crowd {
  std::array<std::vector<float>, 10> values;

  [[nodiscard]] std::size_t count() const { return values[0].size(); }
  [[nodiscard]] ParticleArrays arrays() {
    return {values[0].data(), values[1].data(), values[2].data(), values[3].data(), values[4].data(),
            values[5].data(), values[6].data(), values[7].data(), values[8].data(), values[9].data()};
  }
  void removeDead(const std::vector<std::uint32_t>& dead) {
    for (std::vector<float>& array : values) {
      for (auto which = dead.rbegin(); which != dead.rend(); ++which) array.erase(array.begin() + *which);
    }
  }
};

Crowd randomCrowd(int count, float margin) {
  std::mt19937 random(11);
  const auto uniform = [&](float low, float high) {
    return low + (high - low) * static_cast<float>(random()) / 4294967296.0F;
  };
  Crowd crowd;
  for (int i = 0; i < count; ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      crowd.values[axis].push_back(uniform(margin, kCrowdCells * kCrowdCell - margin));
      crowd.values[3 + axis].push_back(0.0F);
    }
    crowd.values[6].push_back(uniform(0.0F, 4.0F));
    crowd.values[7].push_back(uniform(3.8F, 6.0F));
    crowd.values[8].push_back(uniform(0.0F, 1.0F));
    crowd.values[9].push_back(uniform(1.0F, 3.0F));
  }
  return crowd;
}

/// A smooth draught, `fastest` metres a second along each axis.
Velocity draught(const Layout& layout, float fastest) {
  Velocity velocity(layout);
  for (int z = -1; z <= kCrowdCells + 1; ++z) {
    for (int y = -1; y <= kCrowdCells + 1; ++y) {
      for (int x = -1; x <= kCrowdCells + 1; ++x) {
        const std::ptrdiff_t i = layout.index(x, y, z);
        velocity.x[i] = fastest * std::sin(0.3F * static_cast<float>(y) + 0.2F * static_cast<float>(z));
        velocity.y[i] = fastest * std::cos(0.25F * static_cast<float>(x));
        velocity.z[i] = fastest * std::sin(0.4F * static_cast<float>(x + y));
      }
    }
  }
  return velocity;
}

/// A floor of stones with gaps, into which particles fall and out of which they are pushed.
void placeStones(SolidGrid& solids) {
  constexpr std::size_t kRow = kCrowdCells;
  std::vector<std::uint8_t> stones(kRow * kRow * kRow, 0);
  for (int z = 0; z < kCrowdCells; ++z) {
    for (int y = 0; y < kCrowdCells / 2; ++y) {
      for (int x = 0; x < kCrowdCells; ++x) {
        stones[(static_cast<std::size_t>(z) * kRow + static_cast<std::size_t>(y)) * kRow +
               static_cast<std::size_t>(x)] = x % 7 < 3 && z % 5 < 3 ? 1 : 0;
      }
    }
  }
  for (std::size_t i = 0; i < 6 * kRow * kRow; ++i) stones[17 * kRow * kRow + i] = 1;
  solids.setStatic(stones);
}

double sampleAxis(const Layout& layout, const Field& field, world::Vec3 p) {
  const world::Vec3 low = glm::floor(p);
  double sum = 0.0;
  for (int corner = 0; corner < 8; ++corner) {
    double weight = 1.0;
    std::array<int, 3> at{};
    for (int a = 0; a < 3; ++a) {
      const int high = corner >> a & 1;
      const double share = static_cast<double>(p[a]) - static_cast<double>(low[a]);
      weight *= high == 1 ? share : 1.0 - share;
      at[static_cast<std::size_t>(a)] = static_cast<int>(low[a]) + high;
    }
    sum += weight * static_cast<double>(field[layout.index(at[0], at[1], at[2])]);
  }
  return sum;
}

world::Vec3 sampleAir(const Layout& layout, const Velocity& velocity, world::Vec3 at) {
  world::Vec3 result;
  for (int axis = 0; axis < 3; ++axis) {
    world::Vec3 p = at - 0.5F;
    p[axis] += 0.5F;
    result[axis] = static_cast<float>(sampleAxis(layout, velocity.axis(axis), p));
  }
  return result;
}

float swing(float t) {
  const float f = t - std::floor(t + 0.5F);
  return 16.0F * f * (0.5F - std::abs(f));
}

world::Vec3 octave(world::Vec3 at, float perMetre) {
  const world::Vec3 p = perMetre * at;
  return {swing(p.z) + swing(p.y + 0.25F), swing(p.x) + swing(p.z + 0.25F), swing(p.y) + swing(p.x + 0.25F)};
}

/// What moveParticles() says, one by one.
std::vector<std::uint32_t> movePlainly(Crowd& crowd, const Surroundings& around) {
  const Layout& layout = around.solids.layout();
  const float edge = static_cast<float>(kCrowdCells) - 1.0e-3F;
  auto& v = crowd.values;
  std::vector<std::uint32_t> dead;
  for (std::size_t i = 0; i < crowd.count(); ++i) {
    v[6][i] += kCrowdStep;
    v[8][i] *= std::exp(-v[9][i] * kCrowdStep);
    const world::Vec3 metres(v[0][i], v[1][i], v[2][i]);
    world::Vec3 from = metres / kCrowdCell;
    if (v[6][i] >= v[7][i] || (!inAir(around.solids, from) && !pushOut(around.solids, from))) {
      dead.push_back(static_cast<std::uint32_t>(i));
      continue;
    }
    const world::Vec3 halfway = from + 0.5F * kCrowdStep / kCrowdCell * sampleAir(layout, around.velocity, from);
    const world::Vec3 air =
        sampleAir(layout, around.velocity, glm::clamp(halfway, world::Vec3(0.0F), world::Vec3(edge)));
    const float whirl = std::min(0.3F * glm::length(air), 0.7F) * std::min(v[6][i] / 1.2F, 1.0F);
    const world::Vec3 place(metres.x, kNewest - kEddyPace * v[6][i], metres.z);
    const world::Vec3 speed = air + 0.5F * whirl * (0.55F * octave(place, 1.25F) + 0.45F * octave(place, 3.25F));
    const world::Vec3 to = travel(around.solids, from, kCrowdStep / kCrowdCell * speed);
    if (!inside(layout, to)) dead.push_back(static_cast<std::uint32_t>(i));
    for (int axis = 0; axis < 3; ++axis) {
      v[static_cast<std::size_t>(axis)][i] = kCrowdCell * to[axis];
      v[static_cast<std::size_t>(axis) + 3][i] = speed[axis];
    }
  }
  return dead;
}

std::vector<std::uint32_t> move(Crowd& crowd, const Surroundings& around) {
  std::vector<std::uint32_t> dead(crowd.count());
  dead.resize(moveParticles(crowd.arrays(), crowd.count(), around, kCrowdStep, kNewest, dead.data()));
  return dead;
}

void expectAlike(const Crowd& one, const Crowd& other, float max) {
  ASSERT_EQ(one.count(), other.count());
  for (std::size_t array = 0; array < one.values.size(); ++array) {
    for (std::size_t i = 0; i < one.count(); ++i) {
      const float value = other.values[array][i];
      ASSERT_NEAR(one.values[array][i], value, max * std::max(1.0F, std::abs(value))) << "array " << array << ", " << i;
    }
  }
}

/// Fails if a target samples, whirls, stops at solids or ages otherwise, or forgets the last few particles. The fast
/// draught moves particles by several cells and out of the cube.
TEST(ParticlesKernels, MotionMatchesScalarOnEveryTarget) {
  const Layout layout(kCrowdCells);
  SolidGrid solids(layout, Sides::outdoors());
  placeStones(solids);
  for (const float fastest : {1.0F, 20.0F}) {
    const Velocity velocity = draught(layout, fastest);
    const Surroundings around{solids, velocity, kCrowdCell};
    for (const int count : {1, 3, 15, 16, 17, 64, 1999}) {
      const Crowd before = randomCrowd(count, 0.01F);
      Crowd expected = before;
      const std::vector<std::uint32_t> expectedDead = movePlainly(expected, around);
      EXPECT_TRUE(count < 1000 || !expectedDead.empty());
      expected.removeDead(expectedDead);
      tests::onEachTarget([&] {
        Crowd crowd = before;
        const std::vector<std::uint32_t> dead = move(crowd, around);
        ASSERT_EQ(dead, expectedDead) << count;
        crowd.removeDead(dead);
        expectAlike(crowd, expected, 1.0e-5F * fastest);
      });
    }
  }
}

/// Replicas on different processors: after a second the same particles live, at the same places but for a tenth of a
/// millimetre. (Not next to solids, where a particle that just touches a corner may pass it or not.)
TEST(ParticlesKernels, TargetsAgreeAfterASecond) {
  const Layout layout(kCrowdCells);
  const SolidGrid solids(layout, Sides::outdoors());
  const Velocity velocity = draught(layout, 1.0F);
  const Surroundings around{solids, velocity, kCrowdCell};
  std::vector<Crowd> results;
  tests::onEachTarget([&] {
    Crowd crowd = randomCrowd(1000, 1.5F);
    for (int tick = 0; tick < 30; ++tick) crowd.removeDead(move(crowd, around));
    results.push_back(std::move(crowd));
    EXPECT_GT(results.back().count(), 500U);
    expectAlike(results.back(), results.front(), 1.0e-4F);
  });
}

}  // namespace
}  // namespace grove::objects::fluid
