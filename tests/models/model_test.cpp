#include "models/model.h"

#include <gtest/gtest.h>

#include <limits>

namespace grove::models {
namespace {

TEST(Texture, IsRepeated) {
  const Texture texture{2, 2, {1, 2, 3, 4}};
  EXPECT_EQ(texture.at({0.25F, 0.25F}), 1U);
  EXPECT_EQ(texture.at({7.75F, 0.25F}), 2U);
  EXPECT_EQ(texture.at({-0.75F, -0.25F}), 3U);
  EXPECT_EQ(texture.at({-1.0e-20F, -1.0e-20F}), 4U) << "whose fraction is rounded to one";
}

TEST(Texture, HasATexelForEveryUv) {
  const Texture texture{2, 1, {5, 5}};
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  for (const float uv : {std::numeric_limits<float>::quiet_NaN(), kInfinity, -kInfinity, 3.4e38F, -3.4e38F}) {
    EXPECT_EQ(texture.at({uv, 0.0F}), 5U) << uv;
    EXPECT_EQ(texture.at({0.0F, uv}), 5U) << uv;
  }
}

}  // namespace
}  // namespace grove::models
