#include "raster/shading/detail.h"

#include <algorithm>
#include <cstdlib>

#include "raster/shading/wall.h"

namespace grove::raster {
namespace {

using world::Vec3;

using DetailTest = WallTest;

TEST_F(DetailTest, DepthIsInMetresAndHolesStay) {
  for (const bool weathered : {true, false}) {
    object_.surface.weathered = weathered;
    const auto image = wallAt(4.0F);
    for (std::size_t i = 0; i < kPixels; ++i) {
      const bool hole = i % kWidth < kWidth / 5;
      ASSERT_EQ(image->colour[i] >> 24U, hole ? 0U : 255U);
      if (hole) {
        ASSERT_EQ(image->colour[i], 0U);
        ASSERT_EQ(image->depth[i], world::kInfiniteDepth);
      } else {
        ASSERT_NEAR(image->depth[i], 4.0F, 1.0e-4F);
      }
    }
  }
}

TEST_F(DetailTest, OnlyRockIsWeathered) {
  EXPECT_GT(contrast(*wallAt(0.5F)), 2.0);
  object_.surface.weathered = false;
  const auto image = wallAt(0.5F);
  EXPECT_EQ(contrast(*image), 0.0);
  EXPECT_EQ(image->colour.back(), 0xFF606060U);
}

TEST_F(DetailTest, FadesBeforeAliasing) { EXPECT_LT(contrast(*wallAt(60.0F)), 0.5); }

/// Fails if what leans with the ground has larger metres than the world, so that its detail flickers.
TEST_F(DetailTest, FadesOnLeaningObjectsToo) {
  world::Transform transform;
  transform.yaw = glm::half_pi<float>();
  const auto contrastOf = [&](world::Vec2 slope) {
    transform.slope = slope;
    drawing_.bones[0] = transform.matrix();
    return contrast(*wallAt(2.0F));
  };
  EXPECT_NEAR(contrastOf({0.0F, 1.0F}), contrastOf({0.0F, 0.0F}), 0.1);
}

TEST_F(DetailTest, SunShowsRelief) {
  constexpr std::uint32_t kRelief = 0xF0;
  EXPECT_GT(contrast(*wallAt(0.5F, kRelief)), 1.5 * contrast(*wallAt(0.5F)));
}

TEST_F(DetailTest, MovesWithTheObject) {
  const auto here = wallAt(0.5F);
  const Vec3 moved(3.0F, -1.0F, 7.0F);
  drawing_.bones[0] = world::Transform{moved, 0.0F, 1.0F}.matrix();
  camera_.pose.position += moved;
  const auto there = wallAt(0.5F);
  std::size_t apart = 0;
  for (std::size_t i = 0; i < kPixels; ++i) {
    const int a = static_cast<int>(here->colour[i] >> 8U & 0xFFU);
    const int b = static_cast<int>(there->colour[i] >> 8U & 0xFFU);
    if (std::abs(a - b) > 2) ++apart;
  }
  EXPECT_LT(apart, kPixels / 100);
}

TEST_F(DetailTest, SpansOnlySkipPixels) {
  const auto whole = wallAt(1.0F, 0x84);
  for (int row = 0; row < kHeight; ++row) {
    const int begin = (row * 37) % kWidth;
    spans_.push_back({begin, row % 7 == 0 ? 0 : std::min(kWidth, begin + 1 + row)});
  }
  const auto part = wallAt(1.0F, 0x84);
  ASSERT_EQ(part->spans.size(), static_cast<std::size_t>(kHeight));
  for (int row = 0; row < kHeight; ++row) {
    const Span span = part->span(row);
    ASSERT_EQ(span.begin, spans_[static_cast<std::size_t>(row)].begin);
    ASSERT_EQ(span.end, spans_[static_cast<std::size_t>(row)].end);
    for (int x = span.begin; x < span.end; ++x) {
      ASSERT_EQ(part->colourRow(row)[x], whole->colourRow(row)[x]) << x << ", " << row;
      ASSERT_EQ(part->depthRow(row)[x], whole->depthRow(row)[x]) << x << ", " << row;
    }
  }
}

TEST(DetailTexture, RepeatsWithoutASeam) {
  const DetailTexture texture;
  constexpr std::uint32_t kLast = DetailTexture::kSize - 1;
  const auto square = [&](std::uint32_t x, std::uint32_t y, std::uint32_t z) {
    return texture.squares()[(y * DetailTexture::kSize + x) * DetailTexture::kLine + z];
  };
  for (std::uint32_t i = 0; i < DetailTexture::kSize; ++i) {
    EXPECT_EQ(square(kLast, i, 5) >> 8U & 0xFFU, square(0, i, 5) & 0xFFU);
    EXPECT_EQ(square(i, kLast, 5) >> 16U & 0xFFU, square(i, 0, 5) & 0xFFU);
    EXPECT_EQ(square(i, 9, kLast + 1), square(i, 9, 0));
  }
}

}  // namespace
}  // namespace grove::raster
