#include "objects/lightfield/common/lamps/lamps.h"

#include <gtest/gtest.h>

#include <vector>

namespace grove::objects::lightfield {
namespace {

using world::Vec3;

TEST(ChooseLamps, ChoosesTheNearestInObjectCoordinates) {
  const world::Bounds bounds{{9.0F, 0.0F, -1.0F}, {11.0F, 3.0F, 1.0F}};
  const world::Mat4 toObject = glm::translate(world::Mat4(1.0F), Vec3(-10.0F, 0.0F, 0.0F));
  std::vector<world::PointLight> lights;
  for (int i = 0; i < 8; ++i) lights.push_back({{static_cast<float>(i) * 2.0F, 1.0F, 0.0F}, Vec3(1.0F)});
  const auto chosen = chooseLamps(lights, bounds, toObject);
  ASSERT_EQ(chosen.size(), kMaxLamps);
  EXPECT_EQ(chosen[0].position, Vec3(0.0F, 1.0F, 0.0F));
  EXPECT_TRUE(chooseLamps(std::vector<world::PointLight>{{{-40, 0, 0}, Vec3(1.0F)}}, bounds, toObject).empty());
}

}  // namespace
}  // namespace grove::objects::lightfield
