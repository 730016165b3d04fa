#include "objects/herd/frontend/shadow/shadow_mask_kernels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "each_target.h"

namespace grove::objects::herd {
namespace {

using world::Vec2;

std::size_t indexOf(int x, int y) { return static_cast<std::size_t>(y) * kMaskSide + static_cast<std::size_t>(x); }

/// The share of a texel that a capsule covers.
float coverAt(const FlatCapsule& capsule, int x, int y) {
  const Vec2 off = Vec2(static_cast<float>(x), static_cast<float>(y)) - capsule.from;
  const float square = glm::dot(capsule.way, capsule.way);
  const float share = square > 0.0F ? std::clamp(glm::dot(off, capsule.way) / square, 0.0F, 1.0F) : 0.0F;
  const float inside = glm::mix(capsule.fromRadius, capsule.toRadius, share) - glm::length(off - share * capsule.way);
  return std::clamp(0.5F + 0.5F * inside / capsule.soft, 0.0F, 1.0F);
}

/// Fails if a target leaves out texels at a vector's edge, or covers those that another capsule covers more by less.
TEST(ShadowMaskKernels, CoverCapsulesOnEveryTarget) {
  const FlatCapsule capsules[] = {{{10.0F, 9.0F}, {21.0F, 13.0F}, 4.0F, 6.5F, 1.5F},
                                  {{44.5F, 40.0F}, {0.0F, 0.0F}, 2.0F, 2.0F, 0.6F},
                                  {{30.0F, 22.0F}, {-22.0F, 20.0F}, 0.4F, 0.9F, 3.0F},
                                  {{5.0F, 46.0F}, {1.0F, 8.0F}, 2.0F, 1.0F, 1.0F}};
  tests::onEachTarget([&] {
    std::vector<float> cover(kMaskFloats);
    for (const FlatCapsule& each : capsules) coverCapsule(each, cover.data());
    for (int y = 0; y < kMaskSide; ++y) {
      for (int x = 0; x < kMaskSide; ++x) {
        float expected = 0.0F;
        for (const FlatCapsule& each : capsules) expected = std::max(expected, coverAt(each, x, y));
        ASSERT_NEAR(cover[indexOf(x, y)], expected, 1.0e-3F) << x << ' ' << y;
      }
    }
    EXPECT_EQ(cover.back(), 0.0F);
  });
}

/// Fails if a target packs other neighbours, or in another order.
TEST(ShadowMaskKernels, PackNeighboursOnEveryTarget) {
  std::vector<float> cover(kMaskFloats);
  for (std::size_t i = 0; i < cover.size(); ++i) cover[i] = (static_cast<float>(i * 7 % 256) + 0.25F) / 255.0F;
  tests::onEachTarget([&] {
    std::vector<std::uint32_t> fours(std::size_t{kMaskSide} * kMaskSide);
    packFours(cover.data(), fours.data());
    const auto byte = [&](int x, int y) { return static_cast<std::uint32_t>(indexOf(x, y) * 7 % 256); };
    for (int y = 0; y < kMaskSide - 1; ++y) {
      for (int x = 0; x < kMaskSide - 1; ++x) {
        const std::uint32_t expected =
            byte(x, y) | byte(x + 1, y) << 8U | byte(x, y + 1) << 16U | byte(x + 1, y + 1) << 24U;
        ASSERT_EQ(fours[indexOf(x, y)], expected) << x << ' ' << y;
      }
    }
  });
}

}  // namespace
}  // namespace grove::objects::herd
