#include "objects/fluid/backend/fluid_backend_type.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "world/scenes/scene_file.h"

namespace grove::objects::fluid {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

std::string errorOf(const std::string& settings) {
  const world::Scene scene = world::parseScene("[[object]]\ntype = 'fluid'\nname = 'fire'\n" + settings, "test.toml");
  try {
    (void)FluidBackendType().model(scene.objects.at(0).parameters);
  } catch (const world::SceneError& e) {
    return e.what();
  }
  return "no error";
}

TEST(FluidBackendType, BadSettingsNameFileLineObjectAndKey) {
  EXPECT_EQ(errorOf("grid = 24\nwind = [0, 0, 20]\n"), "no error");
  EXPECT_THAT(errorOf("grid = 20\n"),
              AllOf(StartsWith("test.toml:4: object 'fire': 'grid'"), HasSubstr("must be a multiple of 8")));
  EXPECT_THAT(errorOf("\nwind = [0, 0, 21]\n"),
              AllOf(StartsWith("test.toml:5: object 'fire': 'wind'"), HasSubstr("at most 20 metres per second")));
}

}  // namespace
}  // namespace grove::objects::fluid
