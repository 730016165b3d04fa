#include <gtest/gtest.h>

#include <chrono>
#include <future>

#include "node/nodes_fixture.h"
#include "node/transport/reference_transport.h"

namespace grove::node {
namespace {

class Replies final : public FrontendPort {
 public:
  void receive(ToFrontend message) override { messages.push_back(std::move(message)); }
  std::vector<ToFrontend> messages;
};

/// A backend node of boxes, before a frontend process whose words the test chooses.
class Greeting : public ::testing::Test {
 public:
  Greeting() { transport->connect(replies); }
  ~Greeting() override {
    transport->leaveFrontend();
    workers.drain();
  }

 protected:
  /// The reason for which the node refuses; empty if it welcomes.
  std::string refusalOf(NodeHello hello) {
    replies.messages.clear();
    (void)transport->send(ToBackend(std::move(hello)));
    if (replies.messages.size() != 1) return "no reply";
    const auto* const refusal = std::get_if<NodeRefusal>(&replies.messages[0]);
    return refusal == nullptr ? "" : refusal->reason;
  }

  pipeline::Timeline timeline;
  pipeline::MemoryLedger memory;
  raster::ImagePool images;
  gl::ShaderLibrary shaders;
  gl::Workers gl{gl::ContextKind::kAuto, shaders, 1};
  pipeline::WorkerPool workers{2};
  const BackendTypes types = testing::boxBackends(std::make_shared<testing::BoxControls>());
  const LoadedScene scene =
      loadScene(world::parseScene(
                    "[[object]]\ntype = \"box\"\nname = \"crate\"\nobstacle = 0.5\nposition = [0, 1, -4]\n", "test"),
                types);
  const world::WorldGeometry geometry{scene.objects};
  const std::shared_ptr<ReferenceTransport> transport = std::make_shared<ReferenceTransport>();
  BackendNode backend{scene, geometry, geometry.obstacles(), types, {workers, gl, timeline, memory, images}, {}};
  const std::shared_ptr<void> served = backend.accept(transport);
  Replies replies;
  const NodeHello good{
      .build = "any", .sceneHash = scene.layout.hash, .process = 9, .types = {{.id = 0, .name = "box"}}};
};

TEST_F(Greeting, WelcomesTheSameSceneAndListsItsObjects) {
  EXPECT_EQ(refusalOf(good), "");
  const auto& welcome = std::get<NodeWelcome>(replies.messages[0]);
  EXPECT_EQ(welcome.protocol, kProtocol);
  EXPECT_EQ(welcome.sceneHash, scene.layout.hash);
  EXPECT_FALSE(welcome.visitors) << "the scene shows none";
  const std::uint64_t epoch = welcome.epoch;
  EXPECT_NE(
      BackendNode(scene, geometry, geometry.obstacles(), types, {workers, gl, timeline, memory, images}, {}).epoch(),
      epoch)
      << "another life";
  ASSERT_EQ(welcome.objects.size(), 1u);
  EXPECT_EQ(welcome.objects[0].id, scene.objects[0].id);
  EXPECT_EQ(welcome.objects[0].name, "crate");
  EXPECT_EQ(welcome.objects[0].bounds.low, scene.objects[0].bounds.low);
  EXPECT_EQ(welcome.objects[0].obstacleRadius, 0.5F);
}

TEST_F(Greeting, RefusesAnotherProtocolSceneOrType) {
  NodeHello hello = good;
  hello.protocol = kProtocol + 1;
  EXPECT_EQ(refusalOf(hello), "the protocols differ: the frontend process has " + std::to_string(kProtocol + 1) +
                                  ", this node " + std::to_string(kProtocol));
  hello = good;
  ++hello.sceneHash;
  EXPECT_EQ(refusalOf(hello), "the scenes differ");
  hello = good;
  hello.types.push_back({.id = 1, .name = "dragon"});
  EXPECT_EQ(refusalOf(hello), "this node has no objects of the type dragon");
  hello = good;
  hello.types[0].name = "dragon";
  EXPECT_EQ(refusalOf(hello), "this node has no objects of the type dragon");
}

TEST_F(Greeting, AnswersOnlyWelcomedPeers) {
  Request request;
  request.process = good.process;
  request.object = scene.objects[0].id;
  request.shared = true;
  EXPECT_EQ(transport->send(ToBackend(request)), pipeline::PushResult::kClosed) << "before any word";
  NodeHello hello = good;
  ++hello.sceneHash;
  (void)refusalOf(hello);
  EXPECT_EQ(transport->send(ToBackend(request)), pipeline::PushResult::kClosed);
  (void)refusalOf(good);
  EXPECT_EQ(transport->send(ToBackend(request)), pipeline::PushResult::kAccepted);
}

/// A link over which a frontend process subscribes to nothing, and on which each message takes until it may end.
class SlowLink final : public Transport {
 public:
  using Transport::connect;
  using Transport::send;
  [[nodiscard]] bool sharesMemory() const override { return true; }
  void connect(BackendPort& backend) override { wire_.connect(backend); }
  void connect(FrontendPort& frontend) override { wire_.connect(frontend); }
  void leaveBackend() override { wire_.leaveBackend(); }
  void leaveFrontend() override { wire_.leaveFrontend(); }
  pipeline::PushResult send(ToBackend message) override { return wire_.send(std::move(message)); }
  pipeline::PushResult send(ToFrontend message) override {
    if (std::holds_alternative<Announcement>(message)) {
      begun.set_value();
      mayEnd.get_future().wait();
    }
    return wire_.send(std::move(message));
  }
  void compress(Result& /*result*/, std::string_view /*subject*/) const override {}

  std::promise<void> begun;
  std::promise<void> mayEnd;

 private:
  ReferenceTransport wire_;
};

// Fault: a clock announces a version while the node is destroyed, and reads objects that are gone.
TEST_F(Greeting, DestructionWaitsForAnnouncements) {
  const auto controls = std::make_shared<testing::BoxControls>();
  const BackendTypes announcing = testing::boxBackends(controls);
  auto node =
      std::make_unique<BackendNode>(scene, geometry, geometry.obstacles(), announcing,
                                    BackendMachine{workers, gl, timeline, memory, images}, BackendNode::Progress());
  const auto link = std::make_shared<SlowLink>();
  auto token = node->accept(link);
  (void)link->send(ToBackend(good));
  const auto clock = std::async(std::launch::async, [&] { controls->announce({{scene.objects[0].id, {}}, 1}); });
  link->begun.get_future().wait();
  token.reset();
  const auto destroyed = std::async(std::launch::async, [&] { node.reset(); });
  EXPECT_EQ(destroyed.wait_for(std::chrono::milliseconds(100)), std::future_status::timeout);
  link->mayEnd.set_value();
  EXPECT_EQ(destroyed.wait_for(std::chrono::seconds(30)), std::future_status::ready);
}

}  // namespace
}  // namespace grove::node
