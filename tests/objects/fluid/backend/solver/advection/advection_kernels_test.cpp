#include "objects/fluid/backend/solver/advection/advection_kernels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "each_target.h"
#include "objects/fluid/backend/solver/random_fields.h"

namespace grove::objects::fluid {
namespace {

constexpr float kAdvectionTolerance = 4.0e-6F;  // of values up to 1

/// The value at (i - move) among the 27 around i, and the extremes of the eight that it is made of.
struct PlainSample {
  double value = 0.0;
  float low = 1.0e9F;
  float high = -1.0e9F;
};
PlainSample sample(const SampledPlanes& planes, std::ptrdiff_t stride, std::ptrdiff_t at, const float (&move)[3]) {
  PlainSample result;
  for (int corner = 0; corner < 8; ++corner) {
    double weight = 1.0;
    int step[3];
    for (int a = 0; a < 3; ++a) {
      const bool other = (corner >> a & 1) != 0;
      const double share = static_cast<double>(std::fabs(move[a]));
      weight *= other ? share : 1.0 - share;
      step[a] = !other ? 0 : move[a] > 0.0F ? -1 : 1;
    }
    const float* plane = step[2] == 0 ? planes.here : step[2] < 0 ? planes.below : planes.above;
    const float value = plane[at + stride * step[1] + step[0]];
    result.value += weight * static_cast<double>(value);
    result.low = std::min(result.low, value);
    result.high = std::max(result.high, value);
  }
  return result;
}

struct Scene {
  explicit Scene(int cells, std::mt19937& random)
      : layout(cells),
        field(randomField(layout.size(), random)),
        moves{randomField(layout.size(), random), randomField(layout.size(), random),
              randomField(layout.size(), random)} {
    // Lanes that all move one way, and some that do not move.
    for (int y = 0; y < cells; ++y) {
      for (int x = 0; x < cells + 1; ++x) {
        const std::ptrdiff_t i = layout.index(x, y, 1);
        for (int a = 0; a < 3; ++a) {
          if (y % 4 != 0 && (y >> a & 1) != 0) moves[a][i] = std::fabs(moves[a][i]);
          if (y % 4 != 0 && (y >> a & 1) == 0) moves[a][i] = -std::fabs(moves[a][i]);
          if (x % 7 == a) moves[a][i] = 0.0F;
        }
      }
    }
  }
  [[nodiscard]] const float* plane(const Field& of, int z) const { return of.data() + layout.index(0, 0, z); }
  [[nodiscard]] SampledPlanes planes() const { return {plane(field, 0), plane(field, 1), plane(field, 2)}; }
  [[nodiscard]] Moves scaled(float by) const {
    return {plane(moves[0], 1), plane(moves[1], 1), plane(moves[2], 1), by};
  }

  Layout layout;
  Field field;
  Field moves[3];
};

/// Fails if a target picks another neighbour, weighs it otherwise, or leaves a row's end out.
TEST(AdvectionKernels, SamplingMatchesScalarOnEveryTarget) {
  tests::onEachTarget([] {
    std::mt19937 random(3);
    for (const int cells : {8, 16, 24, 40}) {
      for (const int columns : {cells, cells + 1}) {
        const Scene scene(cells, random);
        const std::ptrdiff_t s = scene.layout.stride;
        const Moves moves = scene.scaled(0.99F);
        Field value = randomField(scene.layout.size(), random);
        Field low = randomField(scene.layout.size(), random);
        Field high = randomField(scene.layout.size(), random);
        const std::ptrdiff_t here = scene.layout.index(0, 0, 1);
        const float untouched = value[here + s];
        sampleNear({columns, 2, cells - 1, s}, scene.planes(), moves,
                   {value.data() + here, low.data() + here, high.data() + here});
        EXPECT_EQ(value[here + s], untouched);
        for (int y = 2; y < cells - 1; ++y) {
          for (int x = 0; x < columns; ++x) {
            const std::ptrdiff_t at = s * y + x;
            const float move[3] = {0.99F * moves.x[at], 0.99F * moves.y[at], 0.99F * moves.z[at]};
            const PlainSample expected = sample(scene.planes(), s, at, move);
            ASSERT_NEAR(value[here + at], expected.value, kAdvectionTolerance) << cells << ' ' << x << ' ' << y;
            ASSERT_EQ(low[here + at], expected.low) << cells << ' ' << x << ' ' << y;
            ASSERT_EQ(high[here + at], expected.high) << cells << ' ' << x << ' ' << y;
          }
        }
      }
    }
  });
}

/// Fails if the way back is taken wrongly, the extremes do not hold, or a value behind a row's end changes.
TEST(AdvectionKernels, CorrectionMatchesScalarOnEveryTarget) {
  tests::onEachTarget([] {
    std::mt19937 random(4);
    for (const int cells : {8, 16, 24, 40}) {
      for (const int columns : {cells, cells + 1}) {
        const Scene scene(cells, random);
        const std::ptrdiff_t s = scene.layout.stride;
        const Moves moves = scene.scaled(0.99F);
        const Field in = randomField(scene.layout.size(), random);
        Field low = randomField(scene.layout.size(), random);
        for (float* v = low.data(); v < low.data() + low.size(); ++v) *v = -std::fabs(*v);
        Field high = randomField(scene.layout.size(), random);
        for (float* v = high.data(); v < high.data() + high.size(); ++v) *v = std::fabs(*v);
        Field out = randomField(scene.layout.size(), random);
        const std::ptrdiff_t here = scene.layout.index(0, 0, 1);
        Field before(out.size());
        before.copyFrom(out);
        correctSamples({columns, 1, cells, s}, scene.planes(), moves, in.data() + here, low.data() + here,
                       high.data() + here, out.data() + here);
        for (int y = 1; y < cells; ++y) {
          for (int x = 0; x < columns; ++x) {
            const std::ptrdiff_t at = s * y + x;
            const float back[3] = {-0.99F * moves.x[at], -0.99F * moves.y[at], -0.99F * moves.z[at]};
            const double there = sample(scene.planes(), s, at, back).value;
            const double better =
                static_cast<double>(scene.planes().here[at]) + 0.5 * (static_cast<double>(in[here + at]) - there);
            const double held =
                std::clamp(better, static_cast<double>(low[here + at]), static_cast<double>(high[here + at]));
            ASSERT_NEAR(out[here + at], held, kAdvectionTolerance) << cells << ' ' << x << ' ' << y;
          }
          EXPECT_EQ(out[here + s * y - 1], before[here + s * y - 1]);
          EXPECT_EQ(out[here + s * y + columns], before[here + s * y + columns]);
        }
      }
    }
  });
}

TEST(AdvectionKernels, MeansAndExtentsMatchScalarOnEveryTarget) {
  tests::onEachTarget([] {
    std::mt19937 random(5);
    for (const int cells : {8, 24}) {
      const Scene scene(cells, random);
      const std::ptrdiff_t s = scene.layout.stride;
      const PlaneExtent extent{cells + 1, 0, cells, s};
      const Moves m = scene.scaled(2.5F);
      Field four(scene.layout.size());
      Field two(scene.layout.size());
      const std::ptrdiff_t here = scene.layout.index(0, 0, 1);
      meanOfFour(extent, m.x, m.x + 1, m.y, m.z, four.data() + here);
      meanOfTwo(extent, m.x, m.x + 1, two.data() + here);
      float longest = 0.0F;
      for (int y = 0; y < cells; ++y) {
        for (int x = 0; x < cells + 1; ++x) {
          const std::ptrdiff_t at = s * y + x;
          ASSERT_NEAR(four[here + at], 0.25F * (m.x[at] + m.x[at + 1] + m.y[at] + m.z[at]), kAdvectionTolerance);
          ASSERT_NEAR(two[here + at], 0.5F * (m.x[at] + m.x[at + 1]), kAdvectionTolerance);
          longest = std::max({longest, std::fabs(m.x[at]), std::fabs(m.y[at]), std::fabs(m.z[at])});
        }
      }
      EXPECT_FLOAT_EQ(longestMove(extent, m), 2.5F * longest);

      Field sparse(scene.layout.size());
      EXPECT_GE(filledRows(extent, sparse.data() + here).first, filledRows(extent, sparse.data() + here).end);
      sparse[here + 3 * s + cells] = 1.0e-30F;
      sparse[here + 5 * s + cells + 1] = 1.0F;  // beyond the end
      sparse[here + 6 * s] = -1.0F;
      EXPECT_EQ(filledRows(extent, sparse.data() + here).first, 3);
      EXPECT_EQ(filledRows(extent, sparse.data() + here).end, 7);
    }
  });
}

}  // namespace
}  // namespace grove::objects::fluid
