#include <gmock/gmock.h>
#include <grpcpp/generic/async_generic_service.h>
#include <grpcpp/generic/generic_stub.h>
#include <grpcpp/grpcpp.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <future>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "base/error.h"
#include "base/tls/certificates.h"
#include "eventually.h"
#include "node/transport/grpc/blocking_call.h"
#include "node/transport/grpc/byte_message.h"
#include "node/transport/grpc/grpc_server.h"
#include "node/transport/grpc/library_hold.h"
#include "node/transport/grpc/link_limits.h"
#include "node/transport/grpc/remote_obstacles.h"
#include "pipeline/worker_pool.h"
#include "world/rays/ray_obstacles.h"

namespace grove::node {
namespace {

using namespace std::chrono_literals;
using ::testing::HasSubstr;
using tests::eventually;

constexpr std::uint64_t kScene = 77;
constexpr world::Cube kCube{{-1.0F, 0.0F, -1.0F}, 2.0F, 20};

/// A closed box, faces outwards.
world::Triangles stone() {
  world::Triangles box;
  for (int i = 0; i < 8; ++i) {
    box.positions.emplace_back((i & 1) != 0 ? 0.4F : -0.5F, (i & 2) != 0 ? 0.9F : 0.0F, (i & 4) != 0 ? 0.3F : -0.6F);
  }
  box.indices = {{0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}, {0, 1, 5}, {0, 5, 4},
                 {2, 6, 7}, {2, 7, 3}, {0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}};
  return box;
}

/// Those of a stone, counted. What is asked while they are held waits.
class StoneObstacles final : public world::VoxelObstacles {
 public:
  [[nodiscard]] std::vector<std::uint8_t> solidCells(const world::Cube& cube) const override {
    const int among = ++working_;
    mostAtOnce_ = std::max<int>(mostAtOnce_, among);
    while (isHeld) std::this_thread::sleep_for(1ms);
    auto cells = stone_.solidCells(cube);
    ++answered;
    --working_;
    return cells;
  }
  [[nodiscard]] std::vector<std::uint8_t> sunlitCells(const world::Cube& cube, world::Vec3 towardsSun) const override {
    return stone_.sunlitCells(cube, towardsSun);
  }
  [[nodiscard]] int working() const { return working_; }
  [[nodiscard]] int mostAtOnce() const { return mostAtOnce_; }

  std::atomic<bool> isHeld{false};
  mutable std::atomic<int> answered{0};

 private:
  const world::RayScene surface_{stone()};
  const world::RayObstacles stone_{surface_, surface_};
  mutable std::atomic<int> working_{0};
  mutable std::atomic<int> mostAtOnce_{0};
};

/// A process that knows obstacles and listens.
struct TellingNode {
  explicit TellingNode(int port = 0, const LinkTls& tls = {}, bool tells = true)
      : server(
            "127.0.0.1:" + std::to_string(port), [](const auto&) { return nullptr; }, workers, timeline, tls,
            tells ? answers : nullptr) {}
  [[nodiscard]] std::string address() const { return "127.0.0.1:" + std::to_string(server.port()); }

  pipeline::Timeline timeline;
  StoneObstacles obstacles;
  pipeline::WorkerPool workers{3};
  const std::shared_ptr<ObstacleAnswers> answers =
      std::make_shared<ObstacleAnswers>(obstacles, kScene, workers, timeline);
  GrpcServer server;
};

std::string errorOf(const world::VoxelObstacles& obstacles, const world::Cube& cube = kCube) {
  try {
    (void)obstacles.solidCells(cube);
    return "no error";
  } catch (const EnvironmentError& e) {
    return e.what();
  }
}

CallEnd askRaw(const std::string& address, const std::string& question) {
  return ask({address, kObstaclesMethod, 30s}, question, {});
}

TEST(ObstacleCalls, TellWhatTheOtherNodeKnows) {
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

TEST(ObstacleCalls, AnotherSceneOrVersionIsRefused) {
  const TellingNode node;
  EXPECT_THAT(errorOf(RemoteObstacles(node.address(), kScene + 1, {})),
              HasSubstr(node.address() + ": the node with the obstacles refuses: it shows another scene"));
  const CallEnd end =
      askRaw(node.address(), encode(ObstacleRequest{.protocol = kProtocol + 1, .sceneHash = kScene, .cube = kCube}));
  EXPECT_EQ(end.status.error_code(), grpc::StatusCode::FAILED_PRECONDITION);
  EXPECT_EQ(end.status.error_message(),
            "it speaks protocol " + std::to_string(kProtocol) + ", who asks " + std::to_string(kProtocol + 1));
  EXPECT_EQ(node.obstacles.answered, 0);
}

TEST(ObstacleCalls, BadQuestionsAreRefusedAndCostOthersNothing) {
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

TEST(ObstacleCalls, ANodeWithoutModelsSaysSo) {
  const TellingNode node(0, {}, false);
  EXPECT_THAT(errorOf(RemoteObstacles(node.address(), kScene, {})),
              HasSubstr("this node tells no obstacles: it has no models of other objects itself"));
}

TEST(ObstacleCalls, WaitForANodeThatComesLater) {
  const int port = TellingNode().server.port();
  const RemoteObstacles remote("127.0.0.1:" + std::to_string(port), kScene, {});
  EXPECT_THAT(errorOf(remote), HasSubstr("no node tells the obstacles: Connection refused"));
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
TEST(ObstacleCalls, ManyAtOnceAreAnsweredOneAfterTheOtherOrRefused) {
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
TEST(ObstacleCalls, WhoHasGivenUpIsNotAnswered) {
  auto node = std::make_unique<TellingNode>();
  node->obstacles.isHeld = true;
  const std::string question = encode(ObstacleRequest{.sceneHash = kScene, .cube = kCube});
  for (int i = 0; i < 4; ++i) {
    const CallEnd end = ask({node->address(), kObstaclesMethod, 300ms}, question, {});
    EXPECT_EQ(end.status.error_code(), grpc::StatusCode::DEADLINE_EXCEEDED);
  }
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

TEST(ObstacleCalls, ACallThatAsksNothingEnds) {
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
  EXPECT_EQ(status.error_message(), "nothing was asked");
}

/// Says the same to whoever asks.
class Liar final : public grpc::CallbackGenericService {
 public:
  explicit Liar(std::string answer) : answer_(std::move(answer)) {
    grpc::ServerBuilder builder;
    builder.AddListeningPort("127.0.0.1:0", grpc::InsecureServerCredentials(), &port_);
    builder.RegisterCallbackGenericService(this);
    server_ = builder.BuildAndStart();
  }
  [[nodiscard]] std::string address() const { return "127.0.0.1:" + std::to_string(port_); }

 private:
  class Lie final : public grpc::ServerGenericBidiReactor {
   public:
    explicit Lie(const std::string& answer) : answer_(messageOf(answer)) {
      StartSendInitialMetadata();
      StartRead(&question_);
    }
    void OnReadDone(bool /*ok*/) override { StartWriteAndFinish(&answer_, grpc::WriteOptions(), grpc::Status::OK); }
    void OnDone() override { delete this; }

   private:
    grpc::ByteBuffer question_;
    const grpc::ByteBuffer answer_;
  };
  grpc::ServerGenericBidiReactor* CreateReactor(grpc::GenericCallbackServerContext* /*context*/) override {
    return new Lie(answer_);
  }

  const std::string answer_;
  int port_ = 0;
  std::unique_ptr<grpc::Server> server_;
};

TEST(ObstacleCalls, AnAnswerThatIsNoneOfThatCubeIsAnError) {
  for (const int edge : {16, 24}) {
    const CubeCells cells(static_cast<std::size_t>(edge) * edge * edge, 1);
    const Liar liar(encodeCells(cells));
    EXPECT_THAT(errorOf(RemoteObstacles(liar.address(), kScene, {})),
                HasSubstr(liar.address() + ": the node with the obstacles is broken: answer about obstacles:"));
  }
  for (const std::string& bytes : {std::string(), std::string("lies"), std::string(kMaxHeaderBytes + 1, '\x0A')}) {
    const Liar liar(bytes);
    EXPECT_THAT(errorOf(RemoteObstacles(liar.address(), kScene, {})), HasSubstr("broken: answer about obstacles:"));
  }
  const Liar giant(std::string(kMaxMessageBytes + 1, 'x'));
  EXPECT_THAT(errorOf(RemoteObstacles(giant.address(), kScene, {})), HasSubstr("larger"));
}

TEST(ObstacleCalls, OnlyATrustedNodeIsHeard) {
  const TestFolder folder;
  const TlsFiles own{folder.file("own.pem"), folder.file("own.key"), "--tls"};
  const TlsFiles other{folder.file("other.pem"), folder.file("other.key"), "--tls"};
  writePair(own);
  writePair(other);
  const TellingNode node(0, readLinkTls(own, ""));
  const auto localhost = [](const TellingNode& at) { return "localhost:" + std::to_string(at.server.port()); };
  const auto trusting = [](const TlsFiles& files) { return readLinkTls({"", "", "--link-tls"}, files.certificate); };
  EXPECT_EQ(errorOf(RemoteObstacles(localhost(node), kScene, trusting(own))), "no error");
  const int answered = node.obstacles.answered;
  EXPECT_THAT(errorOf(RemoteObstacles(localhost(node), kScene, trusting(other))),
              HasSubstr("the node with the obstacles is not trusted: its certificate"));
  EXPECT_EQ(node.obstacles.answered, answered) << "it was asked nothing";
  EXPECT_THAT(errorOf(RemoteObstacles(localhost(node), kScene, {})), HasSubstr("does it want TLS?"));
  const TellingNode plain;
  EXPECT_THAT(errorOf(RemoteObstacles(localhost(plain), kScene, trusting(own))), HasSubstr("does not speak TLS"));
  const TellingNode wantsCertificates(0, readLinkTls(own, own.certificate));
  EXPECT_THAT(errorOf(RemoteObstacles(localhost(wantsCertificates), kScene, trusting(own))),
              HasSubstr("the node with the obstacles refuses: it shows no certificate"));
}

}  // namespace
}  // namespace grove::node
