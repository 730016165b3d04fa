#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "each_target.h"
#include "objects/fluid/backend/solver/forces/confinement_kernels.h"
#include "objects/fluid/backend/solver/forces/forces_kernels.h"
#include "objects/fluid/backend/solver/random_fields.h"

namespace grove::objects::fluid {
namespace {

constexpr float kForceTolerance = 5.0e-6F;  // of values up to about 2

/// Fails if a target pushes a face with another cell's wind or warmth, or leaves out a row's end.
TEST(ForcesKernels, PushMatchesScalarOnEveryTarget) {
  tests::onEachTarget([] {
    std::mt19937 random(12);
    for (const int n : {8, 16, 24}) {
      const Layout layout(n);
      Field faces[3] = {randomField(layout.size(), random), randomField(layout.size(), random),
                        randomField(layout.size(), random)};
      Field before[3] = {Field(layout.size()), Field(layout.size()), Field(layout.size())};
      for (int a = 0; a < 3; ++a) before[a].copyFrom(faces[a]);
      const Field temperature = randomField(layout.size(), random);
      const Field waves = randomField(6 * 64, random);
      WindPush push{0.9F, {0.1F, -0.2F, 0.3F}, {}, {}, 0.25F};
      for (int a = 0; a < 3; ++a) {
        push.sine[a] = waves.data() + 64 * a;
        push.cosine[a] = waves.data() + 64 * (3 + a);
      }
      for (int z = 0; z <= n; ++z) {
        pushPlane(layout, z, push, temperature.data(), {faces[0].data(), faces[1].data(), faces[2].data()});
      }
      for (int z = -1; z <= n + 1; ++z) {
        for (int y = -1; y <= n + 1; ++y) {
          for (int x = -1; x <= n + 1; ++x) {
            const std::ptrdiff_t i = layout.index(x, y, z);
            const int at[3] = {x, y, z};
            for (int a = 0; a < 3; ++a) {
              bool isFace = true;
              for (int k = 0; k < 3; ++k) isFace = isFace && at[k] >= 0 && at[k] < n + (k == a ? 1 : 0);
              float expected = before[a][i];
              if (isFace) {
                // u = sin z + cos y, v = sin x + cos z, w = sin y + cos x
                const int sineOf = (a + 2) % 3;
                const int cosineOf = (a + 1) % 3;
                expected = 0.9F * expected + push.steady[a] + push.sine[sineOf][at[sineOf]] +
                           push.cosine[cosineOf][at[cosineOf]];
                if (a == 1) expected += 0.25F * (temperature[i] + temperature[i - layout.stride]);
              }
              ASSERT_NEAR(faces[a][i], expected, kForceTolerance) << a << ' ' << x << ' ' << y << ' ' << z;
            }
          }
        }
      }
    }
  });
}

TEST(ForcesKernels, GustAndCoolingMatchScalarOnEveryTarget) {
  tests::onEachTarget([] {
    std::mt19937 random(13);
    for (const int n : {8, 16, 24}) {
      const Layout layout(n);
      constexpr float kGustCell = 0.2F;
      const GustCone gust{{0.1F, 0.4F, 0.2F}, {0.48F, 0.6F, 0.64F}, 3.0F, 2.5F};
      int blown = 0;
      for (int axis = 0; axis < 3; ++axis) {
        Field faces = randomField(layout.size(), random);
        Field before(layout.size());
        before.copyFrom(faces);
        for (int z = 0; z < n; ++z) blowPlane(layout, z, axis, gust, kGustCell, faces.data());
        for (int z = 0; z < n; ++z) {
          for (int y = 0; y < n; ++y) {
            for (int x = 0; x < n; ++x) {
              const int at[3] = {x, y, z};
              double away[3];
              double along = 0.0;
              double squared = 0.0;
              for (int k = 0; k < 3; ++k) {
                away[k] = (at[k] + (k == axis ? 0.0 : 0.5)) * static_cast<double>(kGustCell) -
                          static_cast<double>(gust.origin[k]);
                along += away[k] * static_cast<double>(gust.direction[k]);
                squared += away[k] * away[k];
              }
              const std::ptrdiff_t i = layout.index(x, y, z);
              double expected = static_cast<double>(before[i]);
              if (along > 0.0) {
                const double radius = 0.25 + 0.22 * along;
                const double strength =
                    0.4 * std::clamp(2.0 - 2.0 * (squared - along * along) / (radius * radius), 0.0, 1.0);
                const double target = static_cast<double>(gust.direction[axis] * gust.speed) *
                                      std::max(1.0 - along / static_cast<double>(gust.reach), 0.0);
                if ((target - expected) * target > 0.0) expected += strength * (target - expected);
              }
              blown += expected != static_cast<double>(before[i]) ? 1 : 0;
              ASSERT_NEAR(faces[i], expected, 1.0e-4) << axis << ' ' << x << ' ' << y << ' ' << z;
            }
          }
        }
      }
      EXPECT_GT(blown, 10);

      Field t = randomField(layout.size(), random);
      Field warm(layout.size());
      warm.copyFrom(t);
      for (int z = 0; z < n; ++z) coolPlane(layout, z, 0.05F, t.data());
      forEachCell(layout, [&](std::ptrdiff_t i) {
        const double before = static_cast<double>(warm[i]);
        const double cooled = before / (1.0 + 0.05 * (0.28 + 1.6 * before * before * before));
        ASSERT_NEAR(t[i], cooled > 1.0e-6 ? cooled : 0.0, kForceTolerance);
      });
    }
  });
}

/// Fails if a target turns the vorticity or the force another way, or leaves out an end.
TEST(ConfinementKernels, MatchesScalarOnEveryTarget) {
  tests::onEachTarget([] {
    std::mt19937 random(14);
    for (const int n : {8, 16, 24}) {
      const Layout layout(n);
      const std::ptrdiff_t s = layout.stride;
      const ConfinementPlane extent{n, s};
      constexpr int kPlane = 2;
      const std::ptrdiff_t at = layout.index(0, 0, kPlane);
      const std::ptrdiff_t below = at - layout.plane;
      const std::ptrdiff_t above = at + layout.plane;
      const auto plane = [&] { return randomField(layout.size(), random); };
      const Field u = plane();
      const Field v = plane();
      const Field w = plane();

      Field centres(layout.size());
      averageToCentres(extent, v.data() + at, s, centres.data() + at);
      for (int y = -1; y <= n; ++y) {
        for (int x = -1; x <= n; ++x) {
          const std::ptrdiff_t i = layout.index(x, y, kPlane);
          ASSERT_NEAR(centres[i], 0.5F * (v[i] + v[i + s]), kForceTolerance) << x << ' ' << y;
        }
      }

      Field curl[4] = {plane(), plane(), plane(), plane()};
      takeCurl(extent,
               {u.data() + at, v.data() + at, w.data() + at, u.data() + below, v.data() + below, u.data() + above,
                v.data() + above},
               {curl[0].data() + at, curl[1].data() + at, curl[2].data() + at, curl[3].data() + at});
      const std::ptrdiff_t p = layout.plane;
      for (int y = -1; y <= n; ++y) {
        for (int x = -1; x <= n; ++x) {
          if ((y < 0 || y >= n) && (x < 0 || x >= n)) continue;
          const std::ptrdiff_t i = layout.index(std::clamp(x, 0, n - 1), std::clamp(y, 0, n - 1), kPlane);
          const float ox = (w[i + s] - w[i - s]) - (v[i + p] - v[i - p]);
          const float oy = (u[i + p] - u[i - p]) - (w[i + 1] - w[i - 1]);
          const float oz = (v[i + 1] - v[i - 1]) - (u[i + s] - u[i - s]);
          ASSERT_NEAR(curl[0][i], ox, kForceTolerance);
          ASSERT_NEAR(curl[1][i], oy, kForceTolerance);
          ASSERT_NEAR(curl[2][i], oz, kForceTolerance);
          ASSERT_NEAR(curl[3][layout.index(x, y, kPlane)], std::sqrt(ox * ox + oy * oy + oz * oz), kForceTolerance);
        }
      }

      const Field length = plane();
      Field force[3] = {plane(), plane(), plane()};
      takeConfinement(extent,
                      {u.data() + at, v.data() + at, w.data() + at, length.data() + at, length.data() + below,
                       length.data() + above},
                      0.3F, 0.01F, {force[0].data() + at, force[1].data() + at, force[2].data() + at});
      for (int y = 0; y < n; ++y) {
        for (int x = 0; x < n; ++x) {
          const std::ptrdiff_t i = layout.index(x, y, kPlane);
          const float gx = length[i + 1] - length[i - 1];
          const float gy = length[i + s] - length[i - s];
          const float gz = length[i + p] - length[i - p];
          const float g = 0.3F / (std::sqrt(gx * gx + gy * gy + gz * gz) + 0.01F);
          ASSERT_NEAR(force[0][i], g * (gy * w[i] - gz * v[i]), kForceTolerance);
          ASSERT_NEAR(force[1][i], g * (gz * u[i] - gx * w[i]), kForceTolerance);
          ASSERT_NEAR(force[2][i], g * (gx * v[i] - gy * u[i]), kForceTolerance);
        }
      }

      for (const bool isLowest : {false, true}) {
        Field faces[3] = {plane(), plane(), plane()};
        Field before[3] = {Field(layout.size()), Field(layout.size()), Field(layout.size())};
        for (int a = 0; a < 3; ++a) before[a].copyFrom(faces[a]);
        addToFaces(extent, {u.data() + at, v.data() + at, w.data() + at, isLowest ? nullptr : w.data() + below},
                   faces[0].data() + at, faces[1].data() + at, faces[2].data() + at);
        for (int y = -1; y <= n; ++y) {
          for (int x = -1; x <= n; ++x) {
            const std::ptrdiff_t i = layout.index(x, y, kPlane);
            const bool isCell = x >= 0 && x < n && y >= 0 && y < n;
            ASSERT_NEAR(faces[0][i], before[0][i] + (isCell && x > 0 ? 0.5F * (u[i] + u[i - 1]) : 0.0F),
                        kForceTolerance);
            ASSERT_NEAR(faces[1][i], before[1][i] + (isCell && y > 0 ? 0.5F * (v[i] + v[i - s]) : 0.0F),
                        kForceTolerance);
            ASSERT_NEAR(faces[2][i], before[2][i] + (isCell && !isLowest ? 0.5F * (w[i] + w[i - p]) : 0.0F),
                        kForceTolerance);
          }
        }
      }
    }
  });
}

}  // namespace
}  // namespace grove::objects::fluid
