#include <gmock/gmock.h>
#include <grpcpp/generic/async_generic_service.h>
#include <grpcpp/generic/generic_stub.h>
#include <grpcpp/grpcpp.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <future>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "base/error.h"
#include "eventually.h"
#include "node/transport/grpc/calls/blocking_call.h"
#include "node/transport/grpc/calls/remote_obstacles.h"
#include "node/transport/grpc/library_hold.h"
#include "node/transport/grpc/link_limits.h"
#include "node/transport/grpc/obstacle_fixture.h"

namespace grove::node {
namespace {

using namespace std::chrono_literals;
using testing::errorOf;
using ::testing::HasSubstr;
using testing::kCube;
using testing::kScene;
using testing::TellingNode;
using tests::eventually;

CallEnd askRaw(const std::string& address, const std::string& question) {
  return ask({address, kObstaclesMethod, 30s}, question, {});
}

TEST(ObstacleCalls, ReturnCellsOfTheOtherNode) {
  const TellingNode node;
  const RemoteObstacles remote(node.address(), kScene, {});
  remote.waitForNode(0ms);
  const world::Vec3 sun(0.6F, 0.8F, 0.0F);
  for (const int cells : {1, 20, kMaxCubeCells}) {
    const world::Cube cube{kCube.low, kCube.size, cells};
    EXPECT_EQ(remote.solidCells(cube), node.obstacles.solidCells(cube));
    EXPECT_EQ(remote.sunlitCells(cube, sun), node.obstacles.sunlitCells(cube, sun));
  }
  EXPECT_GT(std::ranges::count(remote.solidCells(kCube), 1), 100);
  EXPECT_GT(std::ranges::count(remote.sunlitCells(kCube, sun), 0), 100);
}

TEST(ObstacleCalls, RefuseOtherScenesAndVersions) {
  const TellingNode node;
  EXPECT_THAT(errorOf(RemoteObstacles(node.address(), kScene + 1, {})),
              HasSubstr(node.address() + ": the node with the obstacles refuses: the scenes differ"));
  const CallEnd end =
      askRaw(node.address(), encode(ObstacleRequest{.protocol = kProtocol + 1, .sceneHash = kScene, .cube = kCube}));
  EXPECT_EQ(end.status.error_code(), grpc::StatusCode::FAILED_PRECONDITION);
  EXPECT_EQ(end.status.error_message(), "the protocols differ: the request has " + std::to_string(kProtocol + 1) +
                                            ", the node " + std::to_string(kProtocol));
  EXPECT_EQ(node.obstacles.answered, 0);
}

TEST(ObstacleCalls, BadRequestsCostOthersNothing) {
  const TellingNode node;
  for (const std::string& question :
       {std::string(), std::string("no message"), std::string(kMaxHeaderBytes + 1, 'x'),
        encode(ObstacleRequest{.sceneHash = kScene, .cube = {{}, 1.0F, kMaxCubeCells + 1}}),
        encode(ObstacleRequest{.sceneHash = kScene, .cube = {{}, -1.0F, 8}})}) {
    EXPECT_EQ(askRaw(node.address(), question).status.error_code(), grpc::StatusCode::FAILED_PRECONDITION);
  }
  EXPECT_EQ(node.obstacles.answered, 0);
  EXPECT_EQ(errorOf(RemoteObstacles(node.address(), kScene, {})), "no error");
}

TEST(ObstacleCalls, NodeWithoutModelsReportsIt) {
  const TellingNode node(0, {}, false);
  EXPECT_THAT(errorOf(RemoteObstacles(node.address(), kScene, {})),
              HasSubstr("this node provides no obstacles: it has no models of other objects"));
}

TEST(ObstacleCalls, WaitForALateNode) {
  const int port = TellingNode().server.port();
  const RemoteObstacles remote("127.0.0.1:" + std::to_string(port), kScene, {});
  EXPECT_THAT(errorOf(remote), HasSubstr("no node provides obstacles: Connection refused"));
  std::optional<TellingNode> node;
  std::thread late([&] {
    std::this_thread::sleep_for(700ms);
    node.emplace(port);
  });
  EXPECT_NO_THROW(remote.waitForNode(20s));
  late.join();
  node.reset();
  EXPECT_THROW(remote.waitForNode(300ms), EnvironmentError);
  node.emplace(port);
  EXPECT_EQ(errorOf(remote), "no error") << "a later question finds it again";
}

/// Fails if peers can take more than one core, or if what they ask has no bound.
TEST(ObstacleCalls, ConcurrentCallsAreSerializedOrRefused) {
  TellingNode node;
  node.obstacles.isHeld = true;
  const std::string question = encode(ObstacleRequest{.sceneHash = kScene, .cube = kCube});
  std::vector<std::future<CallEnd>> calls;
  calls.reserve(2 * kMaxObstacleCalls);
  for (int i = 0; i < 2 * kMaxObstacleCalls; ++i) {
    calls.push_back(std::async(std::launch::async, [&] { return askRaw(node.address(), question); }));
  }
  const auto ended = [&] {
    return std::ranges::count_if(calls,
                                 [](const auto& call) { return call.wait_for(0s) == std::future_status::ready; });
  };
  const auto expected = static_cast<std::ptrdiff_t>(2 * kMaxObstacleCalls - ObstacleAnswers::kMaxWaiting - 1);
  EXPECT_TRUE(eventually([&] { return ended() == expected; })) << ended() << " were refused";
  node.obstacles.isHeld = false;
  int refused = 0;
  int answered = 0;
  for (auto& call : calls) {
    const CallEnd end = call.get();
    refused += end.status.error_code() == grpc::StatusCode::RESOURCE_EXHAUSTED ? 1 : 0;
    answered += end.status.ok() ? 1 : 0;
  }
  EXPECT_EQ(refused, expected);
  EXPECT_EQ(refused + answered, 2 * kMaxObstacleCalls);
  EXPECT_EQ(node.obstacles.mostAtOnce(), 1);
}

/// Would catch an answer that is computed for nobody, and a server that waits for it at its end.
TEST(ObstacleCalls, CancelledCallsAreNotAnswered) {
  auto node = std::make_unique<TellingNode>();
  node->obstacles.isHeld = true;
  const std::string question = encode(ObstacleRequest{.sceneHash = kScene, .cube = kCube});
  for (int i = 0; i < 4; ++i) {
    const CallEnd end = ask({node->address(), kObstaclesMethod, 300ms}, question, {});
    EXPECT_EQ(end.status.error_code(), grpc::StatusCode::DEADLINE_EXCEEDED);
  }
  // The node learns of it later than the caller.
  std::this_thread::sleep_for(1s);
  node->obstacles.isHeld = false;
  EXPECT_TRUE(eventually([&] { return node->answers->idle(); }));
  EXPECT_EQ(node->obstacles.answered, 1) << "the one that had begun";
  node->obstacles.isHeld = true;
  auto last = std::async(std::launch::async, [&, address = node->address()] { return askRaw(address, question); });
  EXPECT_TRUE(eventually([&] { return node->obstacles.working() == 1; }));
  node->obstacles.isHeld = false;
  node.reset();
  (void)last.get();
}

TEST(ObstacleCalls, EmptyCallEnds) {
  const TellingNode node;
  const LibraryHold library;
  grpc::GenericStub stub(grpc::CreateChannel(node.address(), grpc::InsecureChannelCredentials()));
  grpc::ClientContext context;
  context.set_deadline(std::chrono::system_clock::now() + 30s);
  grpc::CompletionQueue queue;
  const auto call = stub.PrepareCall(&context, kObstaclesMethod, &queue);
  const auto wait = [&] {
    void* tag = nullptr;
    bool ok = false;
    queue.Next(&tag, &ok);
  };
  call->StartCall(nullptr);
  wait();
  grpc::Status status;
  call->Finish(&status, nullptr);
  wait();
  EXPECT_EQ(status.error_message(), "the call has no request");
}

}  // namespace
}  // namespace grove::node
