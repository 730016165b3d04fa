#include "objects/mesh/detail.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "objects/mesh/bench.h"
#include "objects/mesh/vertex_light.h"

namespace grove::objects::mesh {
namespace {

using world::Vec3;

constexpr int kWidth = 100;
constexpr int kHeight = 40;
constexpr std::size_t kPixels = kWidth * kHeight;
constexpr std::uint32_t kGrey = 0x00606060;

/// A wall that faces the camera at a distance, of one grey, with a hole in its left fifth.
class DetailTest : public testing::Test {
 protected:
  DetailTest() {
    object_.surface = makeBox({1, 1, 1}, Vec3(0.5F));
    object_.surface.weathered = true;
    camera_.width = kWidth;
    camera_.height = kHeight;
    drawing_.object = &object_;
    drawing_.camera = &camera_;
    drawing_.rect = {0, 0, kWidth, kHeight};
    drawing_.bones.fill(world::Mat4(1.0F));
  }

  std::shared_ptr<const node::Image> wallAt(float metres, std::uint32_t material = 0) {
    drawing_.distance = metres;
    std::vector<std::uint32_t> surface(kPixels + kFragmentRoom, kGrey | material << 24U);
    std::vector<float> depth(kPixels + kFragmentRoom, camera_.nearDepth / metres);
    for (std::size_t i = 0; i < kPixels; ++i) {
      if (i % kWidth < kWidth / 5) depth[i] = 0.0F;
    }
    auto image = images_.acquire(drawing_.rect);
    finish({surface.data(), depth.data(), kWidth, spans_}, drawing_, texture_, *image);
    return image;
  }

  /// Standard deviation of green over the wall.
  static double contrast(const node::Image& image) {
    double sum = 0.0;
    double squares = 0.0;
    double count = 0.0;
    for (const std::uint32_t colour : image.colour) {
      if (colour == 0U) continue;
      const double green = colour >> 8U & 0xFFU;
      sum += green;
      squares += green * green;
      count += 1.0;
    }
    return std::sqrt(std::max(0.0, squares / count - sum * sum / (count * count)));
  }

  LitSurface object_;
  world::Camera camera_;
  Drawing drawing_;
  std::vector<node::Span> spans_;
  node::ImagePool images_;
  const DetailTexture texture_;
};

TEST_F(DetailTest, DepthIsInMetresAndHolesStayOpen) {
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

TEST_F(DetailTest, FadesBeforeItIsTooFineForThePixels) { EXPECT_LT(contrast(*wallAt(60.0F)), 0.5); }

TEST_F(DetailTest, TheSunBringsOutRelief) {
  constexpr std::uint32_t kRelief = 0xF0;
  EXPECT_GT(contrast(*wallAt(0.5F, kRelief)), 1.5 * contrast(*wallAt(0.5F)));
}

TEST_F(DetailTest, StaysOnTheObjectWhenTheObjectMoves) {
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

TEST_F(DetailTest, SpansLeaveOutPixelsAndChangeNone) {
  const auto whole = wallAt(1.0F, 0x84);
  for (int row = 0; row < kHeight; ++row) {
    const int begin = (row * 37) % kWidth;
    spans_.push_back({begin, row % 7 == 0 ? 0 : std::min(kWidth, begin + 1 + row)});
  }
  const auto part = wallAt(1.0F, 0x84);
  ASSERT_EQ(part->spans.size(), static_cast<std::size_t>(kHeight));
  for (int row = 0; row < kHeight; ++row) {
    const node::Span span = part->span(row);
    ASSERT_EQ(span.begin, spans_[static_cast<std::size_t>(row)].begin);
    ASSERT_EQ(span.end, spans_[static_cast<std::size_t>(row)].end);
    for (int x = span.begin; x < span.end; ++x) {
      ASSERT_EQ(part->colourRow(row)[x], whole->colourRow(row)[x]) << x << ", " << row;
      ASSERT_EQ(part->depthRow(row)[x], whole->depthRow(row)[x]) << x << ", " << row;
    }
  }
}

/// The height of the detail at a place in texels, and its gradient: the eight texels around it, one by one.
world::Vec4 plainHeight(const DetailTexture& texture, Vec3 at) {
  constexpr auto kSize = static_cast<int>(DetailTexture::kSize);
  const Vec3 cell = glm::floor(at);
  const Vec3 f = at - cell;
  const auto wrapped = [](float value) { return ((static_cast<int>(value) % kSize) + kSize) % kSize; };
  world::Vec4 sum(0.0F);
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 side(corner & 1, corner >> 1 & 1, corner >> 2);
    const Vec3 p = cell + side;
    const int index = (wrapped(p.y) * kSize + wrapped(p.x)) * static_cast<int>(DetailTexture::kLine) + wrapped(p.z);
    const float height = static_cast<float>(texture.squares()[index] & 0xFFU) / 255.0F;
    const Vec3 share = glm::mix(1.0F - f, f, side);
    const Vec3 sign = 2.0F * side - 1.0F;
    sum += height * world::Vec4(sign.x * share.y * share.z, sign.y * share.x * share.z, sign.z * share.x * share.y,
                                share.x * share.y * share.z);
  }
  return sum;
}

/// What finish() computes for one pixel of rock at a point of an object at the origin, in plain words.
Vec3 plainRock(const DetailTexture& texture, Vec3 point, float metres, float focal, Vec3 colour, float relief,
               float lichen) {
  const glm::mat3 turn(0.36F, 0.48F, -0.80F, -0.80F, 0.60F, 0.00F, 0.48F, 0.64F, 0.60F);
  struct Layer {
    glm::mat3 turn;
    float texel;
    float stain;
    float slope;
  };
  float stain = 0.0F;
  float slope = 0.0F;
  for (const Layer& layer : {Layer{turn, 0.034F, 0.40F, 1.05F}, Layer{glm::transpose(turn), 0.0071F, 0.55F, 1.10F},
                             Layer{turn, 0.0016F, 0.50F, 0.90F}}) {
    const float shown = glm::clamp(1.8F * layer.texel * focal / metres - 0.9F, 0.0F, 1.0F);
    const world::Vec4 found = plainHeight(texture, layer.turn * point / layer.texel);
    const Vec3 gradient = glm::transpose(layer.turn) * Vec3(found);
    stain += shown * layer.stain * (found.w - 0.5F);
    slope -= shown * layer.slope * glm::dot(gradient, relief * world::sunDirection() + 0.5F * Vec3(0, 1, 0));
  }
  const float change = glm::clamp(stain + slope, -0.9F, 0.8F);
  const float overgrown = glm::clamp((lichen + 1.1F * stain - 0.42F) * 6.0F, 0.0F, 1.0F);
  const Vec3 by = change + overgrown * Vec3(0.26F, 0.34F, 0.06F) + stain * Vec3(0.22F, 0.0F, -0.22F);
  return glm::clamp(colour * (1.0F + (285.0F - colour) * (0.55F / 285.0F) * by), Vec3(0.0F), Vec3(255.0F));
}

TEST_F(DetailTest, IsThePictureOfThePlainFormula) {
  camera_.pose.yaw = 0.7F;
  camera_.pose.pitch = -0.2F;
  for (const float metres : {0.4F, 1.3F, 3.0F, 7.0F, 20.0F}) {
    const auto image = wallAt(metres, 0x94);
    double sum = 0.0;
    double most = 0.0;
    for (int y = 0; y < kHeight; ++y) {
      for (int x = kWidth / 5; x < kWidth; ++x) {
        const Vec3 ray = camera_.ray(static_cast<float>(x) + 0.5F, static_cast<float>(y) + 0.5F);
        const Vec3 rock = plainRock(texture_, camera_.pose.position + metres * ray, metres, camera_.focal(), Vec3(0x60),
                                    9.0F * kMostRelief / 15.0F, 4.0F / 15.0F);
        for (int channel = 0; channel < 3; ++channel) {
          const auto shown = static_cast<double>(image->colourRow(y)[x] >> (8 * channel) & 0xFFU);
          const double apart = std::abs(shown - static_cast<double>(rock[channel]));
          sum += apart;
          most = std::max(most, apart);
        }
      }
    }
    // Rounding to whole numbers is a quarter on average. Single floats at 5000 texels from the origin tell where a
    // pixel is to a thousandth of a texel, and at the border of two cells the slope jumps.
    EXPECT_LT(sum / (kHeight * kWidth * 0.8 * 3.0), 0.35) << metres;
    EXPECT_LT(most, 12.0) << metres;
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
}  // namespace grove::objects::mesh
