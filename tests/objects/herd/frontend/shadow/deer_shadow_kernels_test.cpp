#include "objects/herd/frontend/shadow/deer_shadow_kernels.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "each_target.h"
#include "objects/herd/common/deer_skeleton.h"
#include "objects/herd/frontend/shadow/capsules.h"
#include "objects/herd/frontend/shadow/shadow_mask.h"
#include "objects/herd/poses.h"
#include "world/camera.h"
#include "world/ground/ground_shadow.h"

namespace grove::objects::herd {
namespace {

using world::Vec2;
using world::Vec3;

constexpr int kRowCounts[] = {1, 3, 8, 17, 200};
constexpr Vec2 kAway(1.0F, 0.0F);
constexpr float kDepth = 6.0F;

/// The hidden share of the sky, as Contact describes it.
float hiddenSky(const Contact& contact, Vec2 at) {
  if (glm::length(at) > contact.radius) return 0.0F;
  const float along = glm::dot(at, contact.ahead) * contact.perLength;
  const float aside = glm::dot(at, Vec2(contact.ahead.y, -contact.ahead.x)) * contact.perWidth;
  const float trunk = std::max(0.0F, 1.0F - along * along - aside * aside);
  float light = 1.0F - contact.trunkStrength * std::pow(trunk, 1.5F);
  for (const Contact::Foot& foot : contact.feet) {
    const float off = glm::length(at - foot.at) / contact.footReach;
    if (off < 1.0F) light *= 1.0F - foot.strength * (1.0F - off * off) * (1.0F - off * off);
  }
  return 1.0F - light;
}

float fadeAt(float height, float bend) {
  return (1.0F - glm::smoothstep(kShadeFadesFrom + bend, kShadeFadesTo + bend, height)) *
         glm::smoothstep(kLowestShade - bend, 0.5F * kLowestShade - bend, height);
}

/// A doe from its left, above a row of pixels with random depths.
class ShadeGroundTest : public testing::Test {
 protected:
  void makeRow(std::size_t count) {
    depths_.assign(count + 1, kDepth);
    bodyDepths_.assign(count + 1, 2.0F * kDepth);
    colours_.assign(count + 1, 0xDEADBEEFU);
    for (std::size_t i = 0; i < count; ++i) {
      const auto share = static_cast<float>(random_() % 1000U) / 1000.0F;
      depths_[i] = random_() % 8U == 0U ? world::kInfiniteDepth : kDepth * (0.93F + 0.1F * share);
      if (random_() % 3U == 0U) bodyDepths_[i] = depths_[i];
      colours_[i] = static_cast<std::uint32_t>(random_());
    }
  }

  [[nodiscard]] ShadeRow row(int count) {
    const Vec3 ray(-0.35F, -1.0F, -0.333F);
    const Vec3 step(1.0F / static_cast<float>(count), 0.0F, 0.0F);
    const auto along = [&](const Affine& value) { return AffineRow(value, eye_, ray, step); };
    ray_ = ray;
    step_ = step;
    return {.height = along(ground_.height),
            .column = along(mask_.column()),
            .line = along(mask_.line()),
            .x = along({{1.0F, 0.0F, 0.0F}, 0.0F}),
            .z = along({{0.0F, 0.0F, 1.0F}, 0.0F}),
            .depths = depths_.data(),
            .colours = colours_.data(),
            .count = count,
            .bodyDepths = bodyDepths_.data() + count / 4,
            .bodyBegin = count / 4,
            .bodyEnd = count - count / 4};
  }

  /// A pixel as shadeGround() describes it.
  [[nodiscard]] std::uint32_t shaded(const ShadeRow& row, int column, std::uint32_t colour) const {
    const auto i = static_cast<std::size_t>(column);
    if (depths_[i] >= world::kInfiniteDepth) return colour;
    const Vec3 place = eye_ + depths_[i] * (ray_ + static_cast<float>(column) * step_);
    const float height = ground_.height.at(place);
    const bool isBody = column >= row.bodyBegin && column < row.bodyEnd && bodyDepths_[i] == depths_[i];
    if (isBody && height > kOwnHeight) return colour;
    const float along = std::max(0.0F, place.x);
    const float fade = fadeAt(height, kGroundBend * along);
    const float reach = 1.0F - glm::smoothstep(kSunFadesAfter * world::kLongestShadow, world::kLongestShadow, along);
    const float sun = kStrength * mask_.at(mask_.column().at(place), mask_.line().at(place)) * fade * reach;
    const float sky = hiddenSky(contact_, {place.x, place.z}) * fade;
    const Vec3 light = (1.0F - sky) * (1.0F - sun * kSunStrength);
    const auto channel = [&](unsigned shift, float share) {
      return static_cast<std::uint32_t>(static_cast<float>(colour >> shift & 0xFFU) * share) << shift;
    };
    return (colour & 0xFF000000U) | channel(0, light.r) | channel(8, light.g) | channel(16, light.b);
  }

  static constexpr float kStrength = 0.9F;
  const AnimalPose pose_ = standingAt({0, 0, 0}, 1.5707963F);
  const Ground ground_{pose_};
  const Contact contact_{pose_, 1.0F, ground_};
  const SunMask mask_{capsulesOf(pose_, 1.0F, false), glm::normalize(Vec3(-1.0F, 0.6F, 0.0F)), ground_.point};
  const Vec3 eye_{0.0F, 6.0F, 2.0F};
  std::mt19937 random_{11};
  std::vector<float> depths_;
  std::vector<float> bodyDepths_;
  std::vector<std::uint32_t> colours_;
  Vec3 ray_{0.0F};
  Vec3 step_{0.0F};
};

/// Fails if a target takes another texel, forgets a hoof or the animal's own pixels, or writes beyond the end.
TEST_F(ShadeGroundTest, DarkensAsDescribedOnEveryTarget) {
  tests::onEachTarget([&] {
    int darker = 0;
    for (const int count : kRowCounts) {
      makeRow(static_cast<std::size_t>(count));
      const std::vector<std::uint32_t> before = colours_;
      const ShadeRow pixels = row(count);
      shadeGround({mask_.texels(), kStrength, kAway, contact_}, pixels);
      for (int column = 0; column < count; ++column) {
        const auto i = static_cast<std::size_t>(column);
        const std::uint32_t expected = shaded(pixels, column, before[i]);
        darker += expected != before[i] ? 1 : 0;
        for (unsigned shift = 0; shift < 32; shift += 8) {
          ASSERT_NEAR(static_cast<double>(colours_[i] >> shift & 0xFFU), static_cast<double>(expected >> shift & 0xFFU),
                      2.0)
              << column << " of " << count;
        }
      }
      EXPECT_EQ(colours_.back(), 0xDEADBEEFU);
    }
    EXPECT_GT(darker, 60);
  });
}

}  // namespace
}  // namespace grove::objects::herd
