#include "world/strongest_lights.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace grove::world {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

float red(const PointLight& light) { return light.colour.r; }

std::vector<float> redOf(const std::vector<PointLight>& lights) {
  std::vector<float> values;
  values.reserve(lights.size());
  for (const PointLight& light : lights) values.push_back(light.colour.r);
  return values;
}

TEST(StrongestLights, AreBoundedAndSorted) {
  std::vector<PointLight> lights;
  for (const float strength : {2.0F, 5.0F, 1.0F, 4.0F, 3.0F}) lights.push_back({Vec3(0.0F), Vec3(strength)});
  EXPECT_THAT(redOf(strongestLights(lights, 3, 0.0F, red)), ElementsAre(5.0F, 4.0F, 3.0F));
  EXPECT_THAT(redOf(strongestLights(lights, 9, 1.0F, red)), ElementsAre(5.0F, 4.0F, 3.0F, 2.0F));
  EXPECT_THAT(strongestLights(lights, 9, 5.0F, red), IsEmpty());
  EXPECT_THAT(strongestLights({}, 9, 0.0F, red), IsEmpty());
}

}  // namespace
}  // namespace grove::world
