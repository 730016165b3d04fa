#include "objects/lightfield/format/view_sphere.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <set>

namespace grove::objects::lightfield {
namespace {

using world::Vec3;

/// Where a direction of the upper hemisphere lies on the unfolded octahedron, in steps of the lattice.
world::Vec2 unfolded(const ViewSphere& sphere, Vec3 d) {
  const float sum = std::abs(d.x) + std::max(d.y, 0.0F) + std::abs(d.z);
  return world::Vec2(d.x, d.z) * (static_cast<float>(sphere.subdivision()) / sum);
}

world::Vec2 lattice(const ViewSphere& sphere, int view) {
  const auto [i, j] = sphere.point(view);
  return {i, j};
}

std::vector<Vec3> someDirections(int count) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> unit(0.0F, 1.0F);
  std::vector<Vec3> directions{{0, 1, 0},  {1, 0, 0},   {0, 0, 1},     {-1, 0, 0},         {0, 0, -1}, {1, 0, 1},
                               {-1, 0, 1}, {-1, 1, -1}, {1e-9F, 1, 0}, {-1, 1e-9F, 1e-9F}, {0, -1, 0}, {3, -0.1F, -2}};
  while (static_cast<int>(directions.size()) < count) {
    const float y = unit(random);
    const float a = 2.0F * std::numbers::pi_v<float> * unit(random);
    const float r = std::sqrt(1.0F - y * y);
    directions.emplace_back(r * std::cos(a), y, r * std::sin(a));
  }
  return directions;
}

TEST(ViewSphere, CountsItsViews) {
  EXPECT_EQ(ViewSphere(64).views(), 8321);
  for (int n = 1; n <= ViewSphere::kMaxSubdivision; ++n) {
    int points = 0;
    for (int j = -n; j <= n; ++j) points += 2 * (n - std::abs(j)) + 1;
    EXPECT_EQ(ViewSphere(n).views(), points);
    EXPECT_EQ(ViewSphere(n).views(), 2 * n * n + 2 * n + 1);
  }
}

TEST(ViewSphere, IndexesEveryPointOnce) {
  for (int n = 1; n <= ViewSphere::kMaxSubdivision; ++n) {
    const ViewSphere sphere(n);
    int expected = 0;
    for (int j = -n; j <= n; ++j) {
      for (int i = std::abs(j) - n; i <= n - std::abs(j); ++i, ++expected) {
        ASSERT_EQ(sphere.view({i, j}), expected) << n;
        ASSERT_EQ(sphere.point(expected), (ViewSphere::Point{i, j})) << n;
      }
    }
  }
}

TEST(ViewSphere, DirectionsAreUnitAndNotBelowTheGround) {
  for (const int n : {1, 2, 7, 64, 128}) {
    const ViewSphere sphere(n);
    std::set<std::array<int, 3>> different;
    for (int view = 0; view < sphere.views(); ++view) {
      const Vec3 d = sphere.direction(view);
      ASSERT_NEAR(glm::length(d), 1.0F, 1e-6F);
      ASSERT_GE(d.y, 0.0F);
      const auto rounded = [](float v) { return static_cast<int>(std::lround(v * 1.0e6F)); };
      different.insert({rounded(d.x), rounded(d.y), rounded(d.z)});
    }
    EXPECT_EQ(static_cast<int>(different.size()), sphere.views());
    EXPECT_EQ(sphere.direction(sphere.view({0, 0})), Vec3(0, 1, 0));
  }
}

TEST(ViewSphere, NearestWeightsReproduceTheDirection) {
  for (const int n : {1, 2, 3, 8, 64, 127, 128}) {
    const ViewSphere sphere(n);
    for (const Vec3& direction : someDirections(2000)) {
      const auto [views, weights] = sphere.nearest(direction);
      const world::Vec2 query = unfolded(sphere, direction);
      world::Vec2 mean(0.0F);
      float total = 0.0F;
      for (std::size_t k = 0; k < 4; ++k) {
        ASSERT_GE(views[k], 0);
        ASSERT_LT(views[k], sphere.views());
        ASSERT_GE(weights[k], 0.0F);
        mean += weights[k] * lattice(sphere, views[k]);
        total += weights[k];
      }
      ASSERT_NEAR(total, 1.0F, 1e-5F);
      if (direction.x == 0.0F && direction.z == 0.0F) continue;  // the pole, or below it, where there is no azimuth
      // In a cell without its far corner the mean lies nearer to the others, by less than a fifth of a cell.
      const bool whole = views[3] != views[0];
      const float tolerance = 1.0e-5F * static_cast<float>(n) + (whole ? 0.0F : 0.2F);
      ASSERT_NEAR(mean.x, query.x, tolerance) << n << ' ' << direction.x << ' ' << direction.y << ' ' << direction.z;
      ASSERT_NEAR(mean.y, query.y, tolerance) << n << ' ' << direction.x << ' ' << direction.y << ' ' << direction.z;
    }
  }
}

TEST(ViewSphere, NearestOfAViewIsItself) {
  for (const int n : {1, 2, 5, 64, 128}) {
    const ViewSphere sphere(n);
    for (int view = 0; view < sphere.views(); ++view) {
      const auto [views, weights] = sphere.nearest(sphere.direction(view));
      float weight = 0.0F;
      for (std::size_t k = 0; k < 4; ++k) weight += views[k] == view ? weights[k] : 0.0F;
      ASSERT_NEAR(weight, 1.0F, 1e-3F) << n << ' ' << view;
    }
  }
}

/// The view that is nearest on the unfolded octahedron is among the four and, in a whole cell, is the heaviest.
TEST(ViewSphere, NearestAgreesWithSearch) {
  for (const int n : {1, 2, 5, 16}) {
    const ViewSphere sphere(n);
    for (const Vec3& direction : someDirections(500)) {
      if (direction.y < 0.0F) continue;
      const world::Vec2 query = unfolded(sphere, direction);
      const auto distance = [&](int view) { return glm::distance(lattice(sphere, view), query); };
      int closest = 0;
      for (int view = 1; view < sphere.views(); ++view) {
        if (distance(view) < distance(closest)) closest = view;
      }
      const auto [views, weights] = sphere.nearest(direction);
      const auto best = std::ranges::min_element(views, {}, distance);
      ASSERT_NEAR(distance(*best), distance(closest), 1e-3F) << n;
      const auto heaviest = static_cast<std::size_t>(std::ranges::max_element(weights) - weights.begin());
      const bool whole = views[3] != views[0];
      ASSERT_TRUE(!whole || distance(views[heaviest]) < distance(closest) + 1e-3F) << n;
      for (std::size_t k = 0; k < 4; ++k) ASSERT_TRUE(weights[k] < 1e-4F || distance(views[k]) < 1.4143F) << n;
    }
  }
}

TEST(ViewSphere, WeightsAreContinuousAcrossCells) {
  const ViewSphere sphere(6);
  const auto weightOf = [&](Vec3 direction, int view) {
    const auto nearest = sphere.nearest(direction);
    float weight = 0.0F;
    for (std::size_t k = 0; k < 4; ++k) weight += nearest.view[k] == view ? nearest.weight[k] : 0.0F;
    return weight;
  };
  for (int step = 0; step < 20000; ++step) {
    const float a = static_cast<float>(step) * 0.01F;
    const float b = static_cast<float>(step) * 7.9e-5F;
    const auto at = [&](float s) {
      return Vec3(std::cos(a + s) * std::cos(b), std::sin(b), std::sin(a + s) * std::cos(b));
    };
    for (const int view : sphere.nearest(at(0.0F)).view) {
      ASSERT_NEAR(weightOf(at(0.0F), view), weightOf(at(1.0e-4F), view), 0.01F);
    }
  }
}

}  // namespace
}  // namespace grove::objects::lightfield
