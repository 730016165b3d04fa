#include "objects/lightfield/backend/near/near_renderer.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "each_target.h"
#include "objects/lightfield/backend/near/near_clusters.h"
#include "world/camera.h"

namespace grove::objects::lightfield {
namespace {

using world::Vec3;

constexpr std::uint32_t kRed = 0xFF0000FFU;
constexpr std::uint32_t kGreen = 0xFF00FF00U;
constexpr std::uint32_t kBlue = 0xFFFF0000U;
constexpr int kWidth = 300;  // more than two tiles, and no multiple of any vector
constexpr int kHeight = 137;
constexpr world::Rect kWhole{0, 0, kWidth, kHeight};
constexpr float kFocal = 100.0F;
constexpr float kSample = 16.5F;        // one of sixteen
constexpr float kDepthError = 5.0e-4F;  // of depths up to 6 m, by 15 bits of nearness

/// A camera at the origin that looks along -z.
ObjectCamera camera() {
  ObjectCamera camera;
  camera.perColumn = {1.0F / kFocal, 0, 0};
  camera.perRow = {0, -1.0F / kFocal, 0};
  camera.corner = {-0.5F * kWidth / kFocal, 0.5F * kHeight / kFocal, -1};
  return camera;
}

/// The point at a place of the picture.
Vec3 pointAt(float x, float y, float depth) { return camera().ray(x, y) * depth; }

class NearRendererTest : public testing::Test {
 protected:
  const raster::Image& draw(Clusters& clusters, const Haze& haze = {}, const world::Rect& rect = kWhole) {
    // The second image gets the memory of the first, which is not clear.
    for (int i = 0; i < 2; ++i) {
      if (image_) std::ranges::fill(image_->colour, 0x12345678U);
      image_ = nullptr;
      image_ = renderer_.render(clusters.model(), 0, camera(), haze, rect, images_);
    }
    return *image_;
  }
  [[nodiscard]] std::uint32_t colourAt(int x, int y) const {
    return isInside(x, y) ? image_->colourRow(y - image_->rect.top)[x - image_->rect.left] : 0U;
  }
  [[nodiscard]] float depthAt(int x, int y) const {
    return isInside(x, y) ? image_->depthRow(y - image_->rect.top)[x - image_->rect.left] : world::kInfiniteDepth;
  }

 private:
  [[nodiscard]] bool isInside(int x, int y) const {
    return !world::overlap(image_->rect, {x, y, x + 1, y + 1}).empty();
  }

  pipeline::MemoryLedger memory_;
  raster::ImagePool images_;
  NearRenderer renderer_{memory_};
  std::shared_ptr<raster::Image> image_;
};

/// Fails if pixels get another colour, depth or coverage, at tile borders or at the end of a row, too.
TEST_F(NearRendererTest, LeafHasItsPlaceColourAndDepth) {
  tests::onEachTarget([&] {
    Clusters clusters;
    clusters.addLeaf(pointAt(20.5F, 10, 3), pointAt(290, 10, 3), pointAt(20.5F, 130, 3), kRed);
    (void)draw(clusters);
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        const bool isCovered = x >= 20 && x < 290 && y >= 10 && y < 130;
        if (x == 20 && isCovered) {
          ASSERT_NEAR(colourAt(x, y) >> 24U, 127.5F, kSample);
          ASSERT_EQ(colourAt(x, y) & 0xFFU, colourAt(x, y) >> 24U);
        } else {
          ASSERT_EQ(colourAt(x, y), isCovered ? kRed : 0U) << x << ", " << y;
        }
        ASSERT_NEAR(depthAt(x, y), isCovered ? 3.0F : world::kInfiniteDepth, 3.0F * kDepthError) << x << ", " << y;
      }
    }
  });
}

/// Fails if triangles leave gaps between them, or overlap so that edges get dark.
TEST_F(NearRendererTest, SurfaceOfTrianglesHasNoGaps) {
  tests::onEachTarget([&] {
    constexpr int kColumns = 15;
    std::mt19937 random(7);
    std::uniform_real_distribution<float> offset(-6.0F, 6.0F);
    std::uniform_real_distribution<float> depth(2.0F, 4.0F);
    std::vector<Vec3> vertices;
    for (int row = 0; row < kColumns; ++row) {
      for (int column = 0; column < kColumns; ++column) {
        const bool isRim = column == 0 || column == kColumns - 1 || row == 0 || row == kColumns - 1;
        const float x = -10.0F + 23.0F * static_cast<float>(column) + (isRim ? 0.0F : offset(random));
        const float y = -10.0F + 11.5F * static_cast<float>(row) + (isRim ? 0.0F : offset(random));
        vertices.push_back(pointAt(x, y, depth(random)));
      }
    }
    Clusters clusters;
    for (int row = 0; row + 1 < kColumns; ++row) {
      // A cluster per row of squares, each with vertices of its own.
      std::vector<Vec3> own(vertices.begin() + row * kColumns, vertices.begin() + (row + 2) * kColumns);
      std::vector<NearFace> faces;
      for (std::uint8_t i = 0; i + 1 < kColumns; ++i) {
        const auto below = static_cast<std::uint8_t>(i + kColumns);
        const auto next = static_cast<std::uint8_t>(i + 1);
        const auto last = static_cast<std::uint8_t>(below + 1);
        faces.push_back({i, below, next, next});
        faces.push_back({next, below, last, last});
      }
      clusters.add(own, faces, true, std::vector<std::uint32_t>(own.size(), kGreen),
                   std::vector<std::uint32_t>(own.size(), kBlue));
    }
    (void)draw(clusters);
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) ASSERT_EQ(colourAt(x, y), kGreen) << x << ", " << y;
    }
  });
}

/// Fails if the order of triangles or clusters decides what is in front, or a side has the other one's colour.
TEST_F(NearRendererTest, NearestSideIsSeen) {
  tests::onEachTarget([&] {
    for (const bool nearFirst : {false, true}) {
      Clusters clusters;
      const auto addNear = [&] {
        clusters.addLeaf(pointAt(50, 20, 2), pointAt(100, 20, 2), pointAt(50, 60, 2), kRed, kBlue);
      };
      if (nearFirst) addNear();
      clusters.addLeaf(pointAt(40, 10, 5), pointAt(40, 100, 5), pointAt(200, 10, 5), kRed, kGreen);
      if (!nearFirst) addNear();
      (void)draw(clusters);
      EXPECT_EQ(colourAt(70, 40), kRed);
      EXPECT_NEAR(depthAt(70, 40), 2.0F, 2.0F * kDepthError);
      EXPECT_EQ(colourAt(150, 50), kGreen);
      EXPECT_NEAR(depthAt(150, 50), 5.0F, 5.0F * kDepthError);
    }
  });
}

/// Fails if a face hides what is in front of it, since its middle is nearer.
TEST_F(NearRendererTest, LongFacesAreBehindWhatIsInFrontOfTheirFarEnd) {
  tests::onEachTarget([&] {
    for (const bool longFirst : {false, true}) {
      Clusters clusters;
      const auto addLong = [&] {
        clusters.addLeaf(pointAt(20, 20, 1.0F), pointAt(280, 20, 6.0F), pointAt(20, 100, 1.0F), kRed);
      };
      if (longFirst) addLong();
      clusters.addLeaf(pointAt(240, 30, 3), pointAt(270, 30, 3), pointAt(240, 60, 3), kGreen);
      if (!longFirst) addLong();
      (void)draw(clusters);
      EXPECT_EQ(colourAt(255, 45), kGreen);
      EXPECT_NEAR(depthAt(255, 45), 3.0F, 3.0F * kDepthError);
      EXPECT_EQ(colourAt(100, 45), kRed);
      EXPECT_EQ(colourAt(255, 25) & 0xFFFFFFU, kRed & 0xFFFFFFU);
    }
  });
}

/// Fails if edges are not smoothed: the share of a pixel that a half-plane covers is known for every slope.
TEST_F(NearRendererTest, CoverageOfEdgesIsTheirArea) {
  tests::onEachTarget([&] {
    for (int degrees = 0; degrees < 360; degrees += 7) {
      const float angle = glm::radians(static_cast<float>(degrees));
      const auto at = [&](float along, float across) {
        return pointAt(150 + along * std::cos(angle) - across * std::sin(angle),
                       70 + along * std::sin(angle) + across * std::cos(angle), 2);
      };
      Clusters clusters;
      clusters.addLeaf(at(-40, 0), at(40, 0), at(-40, 40), kRed, kRed);
      (void)draw(clusters);
      double sum = 0.0;
      for (int y = 0; y < kHeight; ++y) {
        for (int x = 0; x < kWidth; ++x) sum += (colourAt(x, y) >> 24U) / 255.0;
      }
      EXPECT_NEAR(sum, 3200.0, 8.0) << degrees;
    }
  });
}

/// Fails if the far wall of a trunk shows through.
TEST_F(NearRendererTest, SmoothSurfacesHaveNoBacksAndMixTheirCorners) {
  tests::onEachTarget([&] {
    Clusters clusters;
    const std::vector<Vec3> corners{pointAt(0, 0, 4), pointAt(kWidth, 0, 4), pointAt(0, kHeight, 4),
                                    pointAt(kWidth, kHeight, 4)};
    const std::vector<std::uint32_t> colours{0xFF000000U, 0xFF0000C8U, 0xFF000000U, 0xFF0000C8U};
    clusters.add(corners, {{0, 2, 1, 1}, {1, 2, 3, 3}}, true, colours, colours);
    const std::vector<Vec3> backwards{pointAt(0, 0, 2), pointAt(kWidth, 0, 2), pointAt(0, kHeight, 2)};
    clusters.add(backwards, {{0, 1, 2, 2}}, true, {kBlue, kBlue, kBlue}, {kBlue, kBlue, kBlue});
    (void)draw(clusters);
    for (int y = 0; y < kHeight; y += 7) {
      for (int x = 0; x < kWidth; x += 3) {
        ASSERT_NEAR(colourAt(x, y) & 0xFFU, 200.0F * (static_cast<float>(x) + 0.5F) / kWidth, 1.01F) << x;
        ASSERT_EQ(colourAt(x, y) >> 8U, 0xFF0000U);
      }
    }
  });
}

/// Fails if a picture has more than the tiles that the object touches, or if a part of a frame shows it elsewhere.
TEST_F(NearRendererTest, PictureHasOnlyTheTilesOfTheObject) {
  Clusters clusters;
  clusters.addLeaf(pointAt(70, 20, 3), pointAt(90, 20, 3), pointAt(70, 40, 3), kRed);
  EXPECT_EQ(draw(clusters).rect, (world::Rect{64, 0, 128, 64}));
  EXPECT_EQ(draw(clusters, {}, {10, 5, 200, 100}).rect, (world::Rect{10, 5, 138, 69}));
  EXPECT_EQ(colourAt(70, 20), kRed);
  EXPECT_EQ(colourAt(69, 20), 0U);
  EXPECT_EQ(colourAt(89, 39), kRed);
  EXPECT_EQ(draw(clusters, {}, {50, 30, 75, 100}).rect, (world::Rect{50, 30, 75, 94})) << "at the part's right edge";
  EXPECT_TRUE(draw(clusters, {}, {100, 5, 200, 100}).rect.empty());
}

/// Fails if haze changes coverage, or is mixed into what is not covered.
TEST_F(NearRendererTest, HazeCoversWhatTheObjectCovers) {
  tests::onEachTarget([&] {
    Clusters clusters;
    clusters.addLeaf(pointAt(20.5F, 10, 3), pointAt(200, 10, 3), pointAt(20.5F, 60, 3), 0xFF6040C8U);
    (void)draw(clusters, {.colour = {0.2F, 0.4F, 0.8F}, .amount = 0.25F});
    const std::array<float, 3> expected{0.75F * 200 + 0.25F * 51, 0.75F * 64 + 0.25F * 102, 0.75F * 96 + 0.25F * 204};
    const float half = static_cast<float>(static_cast<int>(colourAt(20, 30) >> 24U)) / 255.0F;
    EXPECT_NEAR(half, 0.5F, kSample / 255.0F);
    for (const auto& [x, share] : {std::pair{20, half}, std::pair{100, 1.0F}}) {
      for (std::size_t c = 0; c < 3; ++c) {
        EXPECT_NEAR((colourAt(x, 30) >> (8U * c)) & 0xFFU, share * expected[c], 1.5F) << x << ", channel " << c;
      }
    }
    EXPECT_EQ(colourAt(10, 30), 0U);
  });
}

/// Fails if a mapped file that another program overwrites makes the renderer write beyond its buffers.
TEST_F(NearRendererTest, VerticesWithoutANumberAndBehindTheEyeAreNotDrawn) {
  tests::onEachTarget([&] {
    for (const float bad :
         {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(), -3.0e37F}) {
      Clusters clusters;
      clusters.add({pointAt(0, 0, 3), pointAt(0, 130, 3), pointAt(290, 0, 3), {0, 0, 5}}, {{0, 1, 2, 2}, {3, 1, 2, 2}},
                   false, {kRed, kRed}, {kBlue, kBlue});
      clusters.setFirstVertex({bad, bad, -3.0F});
      (void)draw(clusters);
      EXPECT_EQ(colourAt(100, 40), 0U) << bad;
    }
  });
}

}  // namespace
}  // namespace grove::objects::lightfield
