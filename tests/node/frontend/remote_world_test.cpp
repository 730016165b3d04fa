#include "node/frontend/remote_world.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "base/error.h"
#include "node/transport/reference_transport.h"
#include "world/scenes/scene_layout.h"

namespace grove::node {
namespace {

using ::testing::HasSubstr;

constexpr std::array<std::string_view, 2> kTypes = {"tree", "walker"};
constexpr const char* kWood = R"(
[[object]]
type = "tree"
name = "oak"
position = [3, 0, 4]
[[object]]
type = "tree"
[visitor]
type = "walker"
)";

NodeWelcome welcomeOf(std::vector<ServedObject> objects, std::optional<ServedVisitors> visitors = {}) {
  NodeWelcome welcome;
  welcome.objects = std::move(objects);
  welcome.visitors = visitors;
  return welcome;
}

/// A world of nodes that have said this.
class RemoteWorldTest : public ::testing::Test {
 protected:
  RemoteWorld worldOf(const NodeWelcome& first, const NodeWelcome& second, const std::string& scene = kWood) {
    auto router = std::make_unique<NodeRouter>();
    router->add("a", a);
    router->add("b", b);
    a->send(ToFrontend(first));
    b->send(ToFrontend(second));
    return {world::layoutOf(world::parseScene(scene, "test"), kTypes), std::move(router)};
  }
  std::string errorOf(const NodeWelcome& first, const NodeWelcome& second, const std::string& scene = kWood) {
    try {
      (void)worldOf(first, second, scene);
      return "none";
    } catch (const EnvironmentError& e) {
      return e.what();
    }
  }

  const std::shared_ptr<ReferenceTransport> a = std::make_shared<ReferenceTransport>();
  const std::shared_ptr<ReferenceTransport> b = std::make_shared<ReferenceTransport>();
  const ServedObject oak{.id = 1, .name = "oak", .bounds = {{2, 0, 3}, {4, 9, 5}}, .obstacleRadius = 0.5F};
  const ServedObject sapling{.id = 2, .name = "", .bounds = {{-1, 0, -1}, {1, 5, 1}}};
};

/// Would catch objects that nobody sees, trees that one walks through, and bodies and shadows that nobody has.
TEST_F(RemoteWorldTest, LayoutCombinesFileAndNodes) {
  const RemoteWorld world =
      worldOf(welcomeOf({oak}),
              welcomeOf({sapling},
                        ServedVisitors{.bounds = {{-1, 0, -1}, {1, 2, 1}}, .hasOwnBody = true, .castsShadow = true}));
  const world::Layout& layout = world.layout();
  ASSERT_EQ(layout.objects.size(), 2U);
  EXPECT_EQ(layout.objects[0].name, "oak");
  EXPECT_EQ(layout.objects[0].transform.position, (world::Vec3{3, 0, 4}));
  EXPECT_EQ(layout.objects[0].bounds.high, (world::Vec3{4, 9, 5}));
  EXPECT_EQ(layout.objects[1].bounds.high, (world::Vec3{1, 5, 1}));
  const std::vector<world::Obstacle> obstacles = layout.obstacles();
  ASSERT_EQ(obstacles.size(), 1U);
  EXPECT_EQ(obstacles[0].centre, (world::Vec2{3, 4}));
  EXPECT_EQ(obstacles[0].radius, 0.5F);
  ASSERT_TRUE(layout.visitor);
  EXPECT_EQ(layout.visitor->bounds.high, (world::Vec3{1, 2, 1}));
  EXPECT_TRUE(layout.visitor->hasOwnBody);
  EXPECT_TRUE(layout.visitor->castsShadow);
  EXPECT_EQ(world.links().size(), 2U);
}

/// Would catch a node that is one of another world though it shows the same text.
TEST_F(RemoteWorldTest, NamesObjectsAbsentFromItsFile) {
  const NodeWelcome rest = welcomeOf({sapling}, ServedVisitors{});
  ServedObject wrong = oak;
  wrong.id = 3;
  EXPECT_THAT(errorOf(welcomeOf({oak, wrong}), rest), HasSubstr("object 3 oak"));
  wrong = oak;
  wrong.type = 1;
  EXPECT_THAT(errorOf(welcomeOf({wrong}), rest), HasSubstr("object 1 oak"));
  EXPECT_THAT(errorOf(welcomeOf({oak}), rest, "[[object]]\ntype = 'tree'\n[[object]]\ntype = 'tree'\n"),
              HasSubstr("objects of visitors"));
  EXPECT_EQ(errorOf(welcomeOf({oak}), rest), "none");
}

}  // namespace
}  // namespace grove::node
