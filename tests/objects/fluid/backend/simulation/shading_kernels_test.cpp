#include "objects/fluid/backend/simulation/shading_kernels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "each_target.h"

namespace grove::objects::fluid {
namespace {

constexpr float kShadingTolerance = 1.0e-5F;  // of the largest value

struct Places {
  std::array<std::vector<float>, 3> at;

  /// Some of them beyond the cube's sides.
  Places(int count, float size) {
    std::mt19937 random(3);
    for (int i = 0; i < count; ++i) {
      for (std::vector<float>& axis : at) {
        axis.push_back(size * (1.2F * static_cast<float>(random()) / 4294967296.0F - 0.1F));
      }
    }
  }
  [[nodiscard]] ParticlePlaces view() const { return {at[0].data(), at[1].data(), at[2].data(), at[0].size()}; }
};

std::vector<float> randomValues(std::size_t count, float max) {
  std::mt19937 random(static_cast<unsigned>(count));
  std::vector<float> values(count);
  for (float& value : values) value = max * static_cast<float>(random()) / 4294967296.0F;
  return values;
}

std::size_t cubed(int cells) {
  const auto n = static_cast<std::size_t>(cells);
  return n * n * n;
}

std::size_t indexOf(int cells, int x, int y, int z) {
  const auto row = static_cast<std::size_t>(cells);
  return (static_cast<std::size_t>(z) * row + static_cast<std::size_t>(y)) * row + static_cast<std::size_t>(x);
}

void expectNear(const std::vector<float>& values, const std::vector<double>& expected) {
  ASSERT_EQ(values.size(), expected.size());
  const double max = *std::ranges::max_element(expected);
  ASSERT_GT(max, 0.0);
  for (std::size_t i = 0; i < values.size(); ++i) {
    ASSERT_NEAR(static_cast<double>(values[i]), expected[i], static_cast<double>(kShadingTolerance) * max) << i;
  }
}

/// Calls with each of the eight cells around a particle, and its weight.
template <class Visit>
void forCorners(const Places& places, std::size_t i, const LightCells& grid, const Visit& visit) {
  for (int corner = 0; corner < 8; ++corner) {
    double weight = 1.0;
    std::array<int, 3> cell{};
    for (std::size_t a = 0; a < 3; ++a) {
      const double p = std::clamp(static_cast<double>(places.at[a][i]) / static_cast<double>(grid.size) - 0.5, 0.0,
                                  static_cast<double>(grid.cells - 1));
      const int low = static_cast<int>(p);
      const bool high = (corner >> a & 1) != 0;
      weight *= high ? p - low : 1.0 - (p - low);
      cell[a] = std::min(low + (high ? 1 : 0), grid.cells - 1);
    }
    visit(indexOf(grid.cells, cell[0], cell[1], cell[2]), weight);
  }
}

/// Fails if a target finds other corners or weights, at the border or at the last few particles above all.
TEST(ShadingKernels, SpreadAndGatherMatchScalarOnEveryTarget) {
  for (const int cells : {2, 9, 32}) {
    const LightCells grid{cells, 4.0F / static_cast<float>(cells)};
    for (const int count : {1, 7, 16, 301}) {
      const Places places(count, 4.0F);
      const auto amounts = randomValues(static_cast<std::size_t>(count), 0.1F);
      const auto light = randomValues(cubed(cells), 1.2F);
      std::vector<double> depth(cubed(cells), 0.5);
      std::vector<double> received(amounts.size(), 0.0);
      for (std::size_t i = 0; i < amounts.size(); ++i) {
        forCorners(places, i, grid, [&](std::size_t cell, double weight) {
          depth[cell] += weight * static_cast<double>(amounts[i]);
          received[i] += weight * static_cast<double>(light[cell]);
        });
        received[i] = std::min(received[i], 1.0);
      }
      tests::onEachTarget([&] {
        std::vector<float> cellsOf(cubed(cells), 0.5F);
        depositSmoke(places.view(), amounts.data(), grid, cellsOf.data());
        expectNear(cellsOf, depth);
        std::vector<float> result(amounts.size() + 1, -7.0F);
        lightOfParticles(places.view(), grid, light.data(), result.data());
        EXPECT_EQ(result.back(), -7.0F) << "writes beyond the last particle";
        result.pop_back();
        expectNear(result, received);
      });
    }
  }
}

TEST(ShadingKernels, OpticalDepthsMatchScalarOnEveryTarget) {
  for (const std::size_t count : {1U, 5U, 37U}) {
    const auto age = randomValues(count, 3.0F);
    const auto temperature = randomValues(count, 1.5F);
    const std::vector<float> lifetime(count, 4.5F);
    std::vector<double> expected;
    for (std::size_t i = 0; i < count; ++i) {
      expected.push_back(0.3 * (1.0 - static_cast<double>(age[i]) / 4.5) *
                         std::clamp(1.3 - static_cast<double>(temperature[i]), 0.0, 1.0));
    }
    tests::onEachTarget([&] {
      std::vector<float> amounts(count);
      opticalDepths(age.data(), lifetime.data(), temperature.data(), count, 0.3F, amounts.data());
      expectNear(amounts, expected);
    });
  }
}

TEST(ShadingKernels, SkySweepMatchesScalarOnEveryTarget) {
  for (const int cells : {3, 9, 32}) {
    const auto depth = randomValues(cubed(cells), 0.4F);
    std::vector<double> expected(depth.size());
    for (int z = 0; z < cells; ++z) {
      for (int x = 0; x < cells; ++x) {
        double above = 0.0;
        for (int y = cells; y-- > 0;) {
          const auto own = static_cast<double>(depth[indexOf(cells, x, y, z)]);
          expected[indexOf(cells, x, y, z)] = std::exp(-0.6 * (above + 0.5 * own));
          above += own;
        }
      }
    }
    tests::onEachTarget([&] {
      std::vector<float> above(static_cast<std::size_t>(cells));
      std::vector<float> light(depth.size());
      sweepSkyLight(depth.data(), cells, above.data(), light.data());
      expectNear(light, expected);
    });
  }
}

/// What sweepSunLight() says, cell by cell; `step` towards the sun along `axis`.
std::vector<double> sweepPlainly(const std::vector<float>& depth, const std::vector<float>& open, int cells,
                                 std::array<int, 3> axes, int step, std::array<double, 2> shift, double path) {
  std::vector<double> light(depth.size());
  const auto at = [&](int plane, int i, int j) {
    std::array<int, 3> c{};
    c[static_cast<std::size_t>(axes[0])] = plane;
    c[static_cast<std::size_t>(axes[1])] = i;
    c[static_cast<std::size_t>(axes[2])] = j;
    return indexOf(cells, c[0], c[1], c[2]);
  };
  for (int k = 0; k < cells; ++k) {
    const int plane = step > 0 ? cells - 1 - k : k;
    for (int j = 0; j < cells; ++j) {
      for (int i = 0; i < cells; ++i) {
        double sum = k == 0 ? 1.0 : 0.0;
        for (int corner = 0; corner < 4 && k > 0; ++corner) {
          const double pi = std::clamp(i + shift[0], 0.0, cells - 1.0);
          const double pj = std::clamp(j + shift[1], 0.0, cells - 1.0);
          const int i0 = static_cast<int>(pi);
          const int j0 = static_cast<int>(pj);
          const double weight =
              (corner % 2 == 1 ? pi - i0 : 1.0 - (pi - i0)) * (corner / 2 == 1 ? pj - j0 : 1.0 - (pj - j0));
          const std::size_t from =
              at(plane + step, std::min(i0 + corner % 2, cells - 1), std::min(j0 + corner / 2, cells - 1));
          sum += weight * light[from] / (1.0 + path * static_cast<double>(depth[from]));
        }
        light[at(plane, i, j)] = sum * static_cast<double>(open[at(plane, i, j)]);
      }
    }
  }
  return light;
}

/// Fails if a target shifts, borders or dims otherwise, whichever axis the sun stands along.
TEST(ShadingKernels, SunSweepMatchesScalarOnEveryTarget) {
  for (const int cells : {3, 9, 32}) {
    const auto depth = randomValues(cubed(cells), 0.4F);
    auto open = randomValues(cubed(cells), 1.0F);
    for (float& value : open) value = value > 0.1F ? 1.0F : 0.0F;
    const std::ptrdiff_t n = cells;
    for (const std::array<int, 3> axes : {std::array{2, 0, 1}, {1, 0, 2}, {0, 1, 2}}) {
      for (const int step : {1, -1}) {
        for (const auto& [one, other] : {std::pair{-0.53F, 0.21F}, {1.0F, -1.0F}, {0.0F, 0.75F}}) {
          const std::array<std::ptrdiff_t, 3> steps{1, n, n * n};
          const auto stepOf = [&](std::size_t axis) { return steps[static_cast<std::size_t>(axes[axis])]; };
          const SunSweep sweep{.steps = {step > 0 ? -stepOf(0) : stepOf(0), stepOf(1), stepOf(2)},
                               .first = step > 0 ? (n - 1) * stepOf(0) : 0,
                               .shift = {one, other},
                               .path = 1.3F};
          const auto expected =
              sweepPlainly(depth, open, cells, axes, step, {static_cast<double>(one), static_cast<double>(other)}, 1.3);
          tests::onEachTarget([&] {
            std::vector<float> room(static_cast<std::size_t>(2 * (n + 2) * (n + 2)));
            std::vector<float> light = open;
            sweepSunLight(depth.data(), cells, sweep, room.data(), light.data());
            expectNear(light, expected);
          });
        }
      }
    }
  }
}

}  // namespace
}  // namespace grove::objects::fluid
