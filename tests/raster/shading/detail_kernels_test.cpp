#include "raster/shading/detail_kernels.h"

#include <array>
#include <limits>

#include "each_target.h"
#include "raster/shading/vertex_light.h"
#include "raster/shading/wall.h"
#include "world/sky.h"

namespace grove::raster {
namespace {

using world::Vec3;
using DetailKernels = WallTest;

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
    slope -= shown * layer.slope * glm::dot(gradient, relief * world::Sky().sun + 0.5F * Vec3(0, 1, 0));
  }
  const float change = glm::clamp(stain + slope, -0.9F, 0.8F);
  const float overgrown = glm::clamp((lichen + 1.1F * stain - 0.42F) * 6.0F, 0.0F, 1.0F);
  const Vec3 by = change + overgrown * Vec3(0.26F, 0.34F, 0.06F) + stain * Vec3(0.22F, 0.0F, -0.22F);
  return glm::clamp(colour * (1.0F + (285.0F - colour) * (0.55F / 285.0F) * by), Vec3(0.0F), Vec3(255.0F));
}

/// A different colour and material for every pixel, with empty ones between them, at about a distance.
class PatchyWall {
 public:
  PatchyWall(float nearDepth, float metres) {
    for (std::size_t i = 0; i < kPixels + kFragmentRoom; ++i) {
      const auto number = static_cast<std::uint32_t>(i);
      surface.push_back(number * 2654435761U);
      depth.push_back(i % 11 == 3 ? 0.0F : nearDepth / (metres * (1.0F + 0.01F * static_cast<float>(i % 7))));
    }
  }
  [[nodiscard]] Vec3 colour(std::size_t i) const {
    return {surface[i] & 0xFFU, surface[i] >> 8U & 0xFFU, surface[i] >> 16U & 0xFFU};
  }
  [[nodiscard]] float lichen(std::size_t i) const { return static_cast<float>(surface[i] >> 24U & 0xFU) / 15.0F; }
  [[nodiscard]] float relief(std::size_t i) const { return static_cast<float>(surface[i] >> 28U) * kMaxRelief / 15.0F; }

  std::vector<std::uint32_t> surface;
  std::vector<float> depth;
};

/// Fails if a target looks up, interpolates or grades otherwise, or mixes up the pixels of its vectors.
TEST_F(DetailKernels, MatchesTheFormulaOnEveryTarget) {
  camera_.pose.yaw = 0.7F;
  camera_.pose.pitch = -0.2F;
  tests::onEachTarget([&] {
    for (const float metres : {0.4F, 1.3F, 3.0F, 7.0F, 20.0F}) {
      const PatchyWall wall(camera_.nearDepth, metres);
      const auto image = shown(wall.surface, wall.depth);
      double sum = 0.0;
      double highest = 0.0;
      double count = 0.0;
      for (std::size_t i = 0; i < kPixels; ++i) {
        if (wall.depth[i] == 0.0F) {
          ASSERT_EQ(image->colour[i], 0U);
          ASSERT_EQ(image->depth[i], world::kInfiniteDepth);
          continue;
        }
        const float depth = camera_.nearDepth / wall.depth[i];
        ASSERT_NEAR(image->depth[i], depth, 1.0e-6F * depth);
        ASSERT_EQ(image->colour[i] >> 24U, 255U);
        const std::size_t row = i / kWidth;
        const Vec3 ray = camera_.ray(static_cast<float>(i % kWidth) + 0.5F, static_cast<float>(row) + 0.5F);
        const Vec3 rock = plainRock(texture_, camera_.pose.position + depth * ray, depth, camera_.focal(),
                                    wall.colour(i), wall.relief(i), wall.lichen(i));
        for (int channel = 0; channel < 3; ++channel) {
          const auto found = static_cast<double>(image->colour[i] >> (8 * channel) & 0xFFU);
          const double apart = std::abs(found - static_cast<double>(rock[channel]));
          sum += apart;
          count += 1.0;
          highest = std::max(highest, apart);
        }
      }
      // Rounding to whole numbers is a quarter on average. Single floats at 5000 texels from the origin tell where a
      // pixel is to a thousandth of a texel, and at the border of two cells the slope jumps.
      EXPECT_LT(sum / count, 0.35) << metres;
      EXPECT_LT(highest, 12.0) << metres;
    }
  });
}

/// Fails if a target leaves the end of a row out, or goes beyond it.
TEST_F(DetailKernels, EveryTargetStaysWithinItsSpans) {
  const PatchyWall wall(camera_.nearDepth, 1.0F);
  tests::onEachTarget([&] {
    for (const bool weathered : {true, false}) {
      object_.surface.weathered = weathered;
      spans_.clear();
      const auto whole = shown(wall.surface, wall.depth);
      for (int row = 0; row < kHeight; ++row) {
        const int begin = (row * 37) % kWidth;
        spans_.push_back({begin, row % 7 == 0 ? begin : std::min(kWidth, begin + 1 + row)});
      }
      const auto part = shown(wall.surface, wall.depth);
      for (int row = 0; row < kHeight; ++row) {
        const Span span = spans_[static_cast<std::size_t>(row)];
        for (int x = 0; x < kWidth; ++x) {
          const bool inside = x >= span.begin && x < span.end;
          ASSERT_EQ(part->colourRow(row)[x], inside ? whole->colourRow(row)[x] : 1U) << x << ", " << row;
          ASSERT_EQ(part->depthRow(row)[x], inside ? whole->depthRow(row)[x] : 1.0F) << x << ", " << row;
        }
      }
    }
  });
}

constexpr std::size_t kWidest = 16;  // lanes

/// Leaves on the stack, where what is called next has its own, in one lane of each vector what is no number.
[[gnu::noinline]] void spoilTheStack(std::size_t lane) {
  alignas(64) std::array<float, 16384> room{};
  for (std::size_t i = lane; i < room.size(); i += kWidest) room[i] = std::numeric_limits<float>::quiet_NaN();
  asm volatile("" ::"r"(room.data()) : "memory");  // else they are left out
}

/// Fails if a target asks lanes that hold no pixel how near the nearest one is.
TEST_F(DetailKernels, PixelsAreIndependentOnEveryTarget) {
  for (std::size_t near = 0; near < kWidest; ++near) {
    // Far from the camera but for one pixel, which alone shows the finest scales.
    const std::vector<std::uint32_t> surface(kPixels + kFragmentRoom, kGrey | 0xF0000000U);
    std::vector<float> depth(kPixels + kFragmentRoom, camera_.nearDepth / 900.0F);
    depth[kWidth + near] = camera_.nearDepth / 0.4F;
    tests::onEachTarget([&] {
      spans_.clear();
      const auto whole = shown(surface, depth);
      // A pixel and then whole vectors, so that the last vector is all but empty.
      spans_.assign(kHeight, {0, 0});
      spans_[0] = {0, 1};
      spans_[1] = {0, kWidest};
      for (std::size_t lane = 0; lane < kWidest; ++lane) {
        spoilTheStack(lane);
        const auto part = shown(surface, depth);
        ASSERT_EQ(part->colourRow(1)[near], whole->colourRow(1)[near]) << near << ", " << lane;
      }
    });
  }
}

/// Fails if what has no detail is changed otherwise than by its depth's unit.
TEST_F(DetailKernels, EveryTargetLeavesPlainPixels) {
  object_.surface.weathered = false;
  const PatchyWall wall(camera_.nearDepth, 3.0F);
  tests::onEachTarget([&] {
    const auto image = shown(wall.surface, wall.depth);
    for (std::size_t i = 0; i < kPixels; ++i) {
      const float reversed = wall.depth[i];
      ASSERT_EQ(image->colour[i], reversed > 0.0F ? wall.surface[i] | 0xFF000000U : 0U);
      ASSERT_FLOAT_EQ(image->depth[i], reversed > 0.0F ? camera_.nearDepth / reversed : world::kInfiniteDepth);
    }
  });
}

}  // namespace
}  // namespace grove::raster
