#include "objects/lightfield/bake/texture_sampler.h"

#include <gtest/gtest.h>

#include <limits>

namespace grove::bake {
namespace {

using world::Vec2;

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

TEST(TextureSampler, WideLookUpIsTheMean) {
  const TextureSampler black(models::Texture{2, 2, {0xFF000000U, 0xFFFFFFFFU, 0xFFFFFFFFU, 0xFF000000U}});
  EXPECT_NEAR(black.colour({0.25F, 0.25F}, 1.0F).r, 0.0F, 1.0e-6F);
  for (const float texels : {2.0F, 1.0e30F, kInfinity}) {
    EXPECT_NEAR(black.colour({0.25F, 0.25F}, texels).r, 0.5F, 1.0e-6F) << texels;
  }
}

TEST(TextureSampler, HasAColourForEveryUv) {
  const TextureSampler white(models::Texture{2, 1, {0xFFFFFFFFU, 0xFFFFFFFFU}});
  for (const float uv : {kNan, kInfinity, -kInfinity, 3.4e38F}) {
    for (const float texels : {1.0F, kNan}) EXPECT_FLOAT_EQ(white.colour(Vec2(uv), texels).g, 1.0F) << uv;
    EXPECT_EQ(white.alpha(Vec2(uv)), 1.0F) << uv;
  }
}

}  // namespace
}  // namespace grove::bake
