#include "node/frontend/scene_analyzer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "node/boxes.h"
#include "node/limits.h"
#include "pipeline/worker_pool.h"
#include "world/world.h"

namespace grove::node {
namespace {

using ::testing::ElementsAre;

world::Layout layoutOf(const std::string& scene) {
  return loadScene(world::parseScene(scene, "test"), testing::boxBackends()).layout;
}

View lookingAlong(float yaw) {
  View view;
  view.camera.pose = {{0, 1.7F, 0}, yaw, 0};
  return view;
}

std::vector<std::string> names(const std::vector<VisibleObject>& visible) {
  std::vector<std::string> result;
  result.reserve(visible.size());
  for (const VisibleObject& v : visible) result.push_back(v.object.name);
  return result;
}

const std::string kFourBoxes = R"(
[[object]]
type = "box"
name = "near"
position = [0, 1, -5]
[[object]]
type = "box"
name = "far"
position = [1, 1, -50]
[[object]]
type = "box"
name = "behind"
position = [0, 1, 5]
[[object]]
type = "box"
name = "middle"
position = [-1, 1, -20]
)";

TEST(SceneAnalyzer, SendsVisibleObjectsBackToFront) {
  const world::Layout layout = layoutOf(kFourBoxes);
  EXPECT_THAT(names(visibleObjects(layout, lookingAlong(0.0F))), ElementsAre("far", "middle", "near"));
  EXPECT_THAT(names(visibleObjects(layout, lookingAlong(3.14159F))), ElementsAre("behind"));
}

TEST(SceneAnalyzer, OrderFollowsTheViewer) {
  const world::Layout layout = layoutOf(kFourBoxes);
  View view = lookingAlong(3.14159F);
  view.camera.pose.position.z = -60.0F;
  EXPECT_THAT(names(visibleObjects(layout, view)), ElementsAre("behind", "near", "middle", "far"));
}

TEST(SceneAnalyzer, EnclosingObjectsComeFirst) {
  const world::Layout layout = layoutOf(kFourBoxes + "[[object]]\ntype='box'\nname='sky'\nsize=100\nscale=3\n");
  EXPECT_THAT(names(visibleObjects(layout, lookingAlong(0.0F))), ElementsAre("sky", "far", "middle", "near"));
}

TEST(SceneAnalyzer, EqualDistancesHaveOneOrder) {
  const world::Layout layout = layoutOf(R"(
[[object]]
type = "box"
name = "left"
position = [-2, 1.7, -10]
[[object]]
type = "box"
name = "right"
position = [2, 1.7, -10]
)");
  EXPECT_THAT(names(visibleObjects(layout, lookingAlong(0.0F))), ElementsAre("left", "right"));
}

TEST(SceneAnalyzer, ShowsOtherVisitorsButNotTheViewer) {
  const world::Layout layout = layoutOf("spawn=[0,0,-8]\n[visitor]\ntype='box'");
  world::World world(layout);
  const auto me = world.players().join("me", 0.0);
  world.players().join("you", 0.0);
  View view = lookingAlong(0.0F);
  view.viewer = me;
  view.players = world.players().all(0.0);
  const auto visible = visibleObjects(layout, view);
  EXPECT_THAT(names(visible), ElementsAre("you"));
  EXPECT_GE(visible[0].object.id, world::kFirstPlayerObject);
}

TEST(SceneAnalyzer, ShowsTheOwnBodyWhenLookingDown) {
  world::Layout layout = layoutOf("[visitor]\ntype='box'");
  world::World world(layout);
  View view = lookingAlong(0.0F);
  view.viewer = world.players().join("me", 0.0);
  view.players = world.players().all(0.0);
  view.camera.pose = view.players[0].pose;
  const auto seenAt = [&](float pitch) {
    view.camera.pose.pitch = pitch;
    return names(visibleObjects(layout, view));
  };
  EXPECT_THAT(seenAt(-1.2F), ElementsAre()) << "or he would see his figure from inside";
  layout.visitor->hasOwnBody = true;
  EXPECT_THAT(seenAt(-1.2F), ElementsAre("me"));
  EXPECT_THAT(seenAt(0.0F), ElementsAre());
}

/// Would catch a visitor without a shadow of his own, one who is asked for where it cannot be seen, and other visitors
/// whose shadows vanish with their bodies.
TEST(SceneAnalyzer, ShowsShadowsWithoutTheirBodies) {
  world::Layout layout = layoutOf("[visitor]\ntype='box'");
  layout.sky.sun = glm::normalize(world::Vec3(0, 0.2F, 1));
  world::World world(layout);
  View view = lookingAlong(0.0F);
  view.viewer = world.players().join("me", 0.0);
  view.players = world.players().all(0.0);
  view.camera.pose = view.players[0].pose;
  constexpr float kAway = 0.0F;
  constexpr float kTowardsTheSun = 3.14159F;
  const auto seenAt = [&](float yaw) {
    view.camera.pose.yaw = yaw;
    return names(visibleObjects(layout, view));
  };
  EXPECT_THAT(seenAt(kAway), ElementsAre());
  layout.visitor->castsShadow = true;
  EXPECT_THAT(seenAt(kAway), ElementsAre("me"));
  EXPECT_THAT(seenAt(kTowardsTheSun), ElementsAre());
  view.viewer = 0;
  view.camera.pose.position.z -= 3.0F;
  EXPECT_THAT(seenAt(kAway), ElementsAre("me")) << "who stands behind the eye";
  layout.visitor->castsShadow = false;
  EXPECT_THAT(seenAt(kAway), ElementsAre());
}

TEST(SceneAnalyzer, KeepsTheNearestOfTooMany) {
  std::string scene;
  for (int i = 0; i < static_cast<int>(kMaxObjectsPerFrame) + 50; ++i) {
    scene += "[[object]]\ntype='box'\nname='" + std::to_string(i) + "'\nposition=[0,1.7,-" +
             std::to_string(2 + i * 0.5) + "]\n";
  }
  const auto visible = visibleObjects(layoutOf(scene), lookingAlong(0.0F));
  ASSERT_EQ(visible.size(), kMaxObjectsPerFrame);
  EXPECT_EQ(visible.back().object.name, "0");
}

/// In the Frame Planner's place.
class ListShelf final : public pipeline::Stage<FramePlannerInput> {
 public:
  ListShelf(pipeline::Executor& executor, pipeline::Timeline& timeline)
      : Stage({.name = "Lists"}, executor, timeline) {}
  std::vector<std::shared_ptr<const FrameList>> lists;

 protected:
  void process(std::span<FramePlannerInput> inputs, pipeline::Run&) override {
    for (FramePlannerInput& input : inputs) lists.push_back(std::get<std::shared_ptr<const FrameList>>(input));
  }
};

TEST(SceneAnalyzer, ReportsTheNumberOfVisitors) {
  const world::Layout layout = layoutOf(kFourBoxes);
  pipeline::Timeline timeline;
  pipeline::WorkerPool workers(1);
  const auto look = [](FrameNumber frame) {
    View view = lookingAlong(0.0F);
    view.frame = frame;
    view.players.resize(3);
    return view;
  };
  const auto shelf = std::make_shared<ListShelf>(workers, timeline);
  const auto analyzer = std::make_shared<SceneAnalyzer>(
      layout, look, 1.0, [] {}, workers, timeline);
  analyzer->connect(shelf);
  ASSERT_EQ(analyzer->push({.session = 1, .frame = 5}), pipeline::PushResult::kAccepted);
  for (int stage = 0; stage < 2; ++stage) workers.drain();
  ASSERT_EQ(shelf->lists.size(), 1U);
  EXPECT_EQ(shelf->lists[0]->view->frame, 5U);
  EXPECT_EQ(shelf->lists[0]->view->visitors, 3U);
}

}  // namespace
}  // namespace grove::node
