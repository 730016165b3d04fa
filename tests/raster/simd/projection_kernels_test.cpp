#include "raster/simd/projection_kernels.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "each_target.h"

namespace grove::raster {
namespace {

using world::Vec3;

/// Points before a camera that looks at them from a slant.
class ProjectionKernels : public testing::Test {
 protected:
  ProjectionKernels() {
    camera_.pose.yaw = 0.3F;
    camera_.pose.pitch = -0.2F;
    camera_.pose.position = -6.0F * camera_.pose.forward();
  }

  void scatter(std::size_t count) {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> within(-2.0F, 2.0F);
    for (std::vector<float>* axis : {&x_, &y_, &z_}) {
      axis->clear();
      for (std::size_t i = 0; i < count; ++i) axis->push_back(within(random));
    }
  }

  [[nodiscard]] Points points() const { return {x_.data(), y_.data(), z_.data(), x_.size()}; }
  [[nodiscard]] Vec3 expected(std::size_t i) const {
    return camera_.project(Vec3(toWorld_ * world::Vec4(x_[i], y_[i], z_[i], 1.0F)));
  }

  world::Camera camera_;
  const world::Mat4 toWorld_ = world::Transform{Vec3(0.5F, -0.2F, 0.1F), 0.8F, 1.2F}.matrix();
  std::vector<float> x_, y_, z_;
};

TEST_F(ProjectionKernels, MatchesTheCameraOnEveryTarget) {
  tests::onEachTarget([&] {
    for (const std::size_t count : {1U, 3U, 16U, 33U, 100U}) {
      scatter(count);
      std::vector<float> u(count + 1, -1.0F);
      std::vector<float> v(count + 1, -1.0F);
      std::vector<float> depth(count + 1, -1.0F);
      const float nearest = transform(points(), Projection(camera_, toWorld_), u.data(), v.data(), depth.data());
      float expectedNearest = world::kInfiniteDepth;
      for (std::size_t i = 0; i < count; ++i) {
        ASSERT_NEAR(u[i] / depth[i], expected(i).x, 1.0e-3F) << i << " of " << count;
        ASSERT_NEAR(v[i] / depth[i], expected(i).y, 1.0e-3F) << i << " of " << count;
        ASSERT_NEAR(depth[i], expected(i).z, 1.0e-5F) << i << " of " << count;
        expectedNearest = std::min(expectedNearest, expected(i).z);
      }
      EXPECT_NEAR(nearest, expectedNearest, 1.0e-5F);
      EXPECT_EQ(u[count], -1.0F);
      EXPECT_EQ(v[count], -1.0F);
      EXPECT_EQ(depth[count], -1.0F);
    }
  });
}

TEST_F(ProjectionKernels, ExtentMatchesScalarOnEveryTarget) {
  tests::onEachTarget([&] {
    for (const std::size_t count : {1U, 3U, 16U, 33U, 100U}) {
      scatter(count);
      constexpr float kFar = std::numeric_limits<float>::max();
      Extent all{kFar, -kFar, kFar, -kFar, kFar};
      for (std::size_t i = 0; i < count; ++i) {
        const Vec3 at = expected(i);
        all = {std::min(all.left, at.x), std::max(all.right, at.x), std::min(all.top, at.y), std::max(all.bottom, at.y),
               std::min(all.nearest, at.z)};
      }
      const Extent found = extentOf(points(), Projection(camera_, toWorld_));
      EXPECT_NEAR(found.left, all.left, 1.0e-3F) << count;
      EXPECT_NEAR(found.right, all.right, 1.0e-3F) << count;
      EXPECT_NEAR(found.top, all.top, 1.0e-3F) << count;
      EXPECT_NEAR(found.bottom, all.bottom, 1.0e-3F) << count;
      EXPECT_NEAR(found.nearest, all.nearest, 1.0e-5F) << count;
    }
  });
}

/// Fails if a target mixes up planes or vertices. A place may round to the next step of the grid.
TEST_F(ProjectionKernels, CornersMatchScalarOnEveryTarget) {
  constexpr float kNear = 0.1F;
  tests::onEachTarget([&] {
    std::mt19937 random(9);
    std::uniform_real_distribution<float> pixel(-100.0F, 1400.0F);
    std::uniform_real_distribution<float> metres(0.1F, 50.0F);
    for (const std::size_t count : {1U, 3U, 16U, 37U}) {
      ScreenVertices vertices;
      std::vector<float> lichen;
      for (std::size_t i = 0; i < count; ++i) {
        vertices.depth.push_back(metres(random));
        vertices.u.push_back(pixel(random) * vertices.depth[i]);
        vertices.v.push_back(pixel(random) * vertices.depth[i]);
        vertices.light.push_back(static_cast<std::uint32_t>(random()));
        lichen.push_back(static_cast<float>(i % 5) / 4.0F);
      }
      const Corner kept{1, 2, {3, 4, 5, 6, 7, 8}};
      vertices.corners.assign(count + 1, kept);
      makeCorners(vertices.u.data(), vertices.v.data(), vertices.depth.data(), vertices.light.data(), lichen.data(),
                  count, kNear, vertices.corners.data());
      for (std::size_t i = 0; i < count; ++i) {
        const Corner expected = projected(vertices.clipVertex(i, lichen[i]), kNear);
        const Corner& corner = vertices.corners[i];
        ASSERT_NEAR(corner.x, expected.x, kSubPixel) << i << " of " << count;
        ASSERT_NEAR(corner.y, expected.y, kSubPixel) << i << " of " << count;
        ASSERT_EQ(corner.x, std::round(corner.x / kSubPixel) * kSubPixel);
        ASSERT_EQ(corner.y, std::round(corner.y / kSubPixel) * kSubPixel);
        for (std::size_t k = 0; k < corner.planes.size(); ++k) {
          ASSERT_NEAR(corner.planes[k], expected.planes[k], 1.0e-6F * expected.planes[k]) << "plane " << k;
        }
      }
      EXPECT_EQ(vertices.corners[count].x, kept.x);
      EXPECT_EQ(vertices.corners[count].planes, kept.planes);
    }
  });
}

}  // namespace
}  // namespace grove::raster
