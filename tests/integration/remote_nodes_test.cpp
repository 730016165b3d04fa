#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <string>
#include <thread>

#include "base/error.h"
#include "eventually.h"
#include "integration/node_program.h"
#include "integration/picture.h"
#include "integration/remote_world.h"
#include "integration/served_scene.h"
#include "integration/stones.h"
#include "stream/session/headless_session.h"

namespace grove::integration {
namespace {

using namespace std::chrono_literals;
using ::testing::HasSubstr;
using tests::eventually;

/// A server whose world is in part in other processes.
class RemoteNodes : public ::testing::Test {
 public:
  ~RemoteNodes() override { std::filesystem::remove(file); }

 protected:
  RemoteNodes() { std::ofstream(file) << kStones; }

  static std::unique_ptr<ServedScene> serve(const std::vector<std::string>& nodes, node::ProcessId process = 1) {
    stream::HostOptions options;
    options.process = process;
    return std::make_unique<ServedScene>(kStones, options, node::TransportFactory(), nodes);
  }
  std::unique_ptr<NodeProgram> node(const std::string& objects, int port = 0) const {
    return std::make_unique<NodeProgram>(file.string(), objects, port);
  }

  static Picture settled(stream::HeadlessSession& visitor) {
    return settledPicture(visitor, visitor.control(0, 0.0F, 0.0F), 60);
  }
  /// The neighbour comes first: a picture from before may show no light of his lantern for seconds.
  static Picture shownByOneProcess() {
    const auto served = serve({});
    const stream::HeadlessSession neighbour(served->host, "Bob", 160, 90);
    stream::HeadlessSession visitor(served->host, "Ada", 320, 180);
    return settled(visitor);
  }
  static std::string errorOf(const std::vector<std::string>& nodes) {
    try {
      (void)serve(nodes);
      return "";
    } catch (const EnvironmentError& e) {
      return e.what();
    }
  }

  const std::filesystem::path file =
      std::filesystem::temp_directory_path() / ("grove_remote_nodes_" + std::to_string(getpid()) + ".toml");
};

TEST_F(RemoteNodes, ShowTheSamePictureAsOneProcess) {
  const Picture local = shownByOneProcess();
  const auto stones = node("right,figure");
  const auto ground = node("ground,left");
  const auto served = serve({stones->address(), ground->address()});
  const stream::HeadlessSession neighbour(served->host, "Bob", 160, 90);
  stream::HeadlessSession visitor(served->host, "Ada", 320, 180);
  EXPECT_EQ(difference(local, settled(visitor)), 0.0);
  EXPECT_GT(local.mean(), 1.0) << "of nothing";
  EXPECT_GT(served->host.traffic().sharedData, 0U) << "the ground came from elsewhere";
  EXPECT_GT(served->host.traffic().pictures, 0U) << "and the stone";
}

/// Would catch whatever a server without models knows otherwise than one that has them.
TEST_F(RemoteNodes, ServeAServerWithoutModels) {
  const Picture local = shownByOneProcess();
  const auto stones = node("right,figure,sky");
  const auto ground = node("ground,left");
  const node::FrontendTypes types = objects::builtinTypes().frontends;
  stream::Host host(remoteWorld(kStones, types, {stones->address(), ground->address()}), types,
                    ServedScene::patient({}), {});
  const stream::HeadlessSession neighbour(host, "Bob", 160, 90);
  stream::HeadlessSession visitor(host, "Ada", 320, 180);
  EXPECT_EQ(difference(local, settled(visitor)), 0.0);
  EXPECT_EQ(host.nodeLinks().size(), 2U);
}

TEST_F(RemoteNodes, RestartDropsNobodyAndKeepsTheLastPicture) {
  auto remote = node("mesh,ground");
  const int port = remote->port();
  const auto served = serve({remote->address()});
  stream::HeadlessSession visitor(served->host, "Ada", 320, 180);
  const Picture before = settled(visitor);
  remote->end(SIGKILL);
  std::this_thread::sleep_for(300ms);
  const std::uint64_t received = visitor.framesReceived();
  EXPECT_EQ(difference(before, settled(visitor)), 0.0) << "as it was";
  EXPECT_GT(visitor.framesReceived(), received) << "frames go on";
  const std::uint64_t traffic = served->host.traffic().pictures;
  remote = node("mesh,ground", port);
  ASSERT_EQ(remote->port(), port);
  const auto isBack = [&] { return served->host.traffic().pictures > traffic; };
  EXPECT_TRUE(eventually([&] {
    (void)visitor.control(0, 0.0F, 0.01F);
    (void)visitor.control(0, 0.0F, 0.0F);
    return isBack();
  }));
  EXPECT_EQ(difference(before, settled(visitor)), 0.0);
  EXPECT_EQ(served->host.visitors(), 1U);
  EXPECT_EQ(remote->end(SIGTERM), 0) << "it stops cleanly with a link";
}

/// Would catch an operator who sees what his server does only, and a trace in which the node works before its request.
TEST_F(RemoteNodes, ReportStagesAndTrace) {
  const auto remote = node("mesh,ground");
  const auto served = serve({remote->address()});
  stream::HeadlessSession visitor(served->host, "Ada", 320, 180);
  (void)settled(visitor);
  const auto report = [&] { return served->host.nodeLinks().at(0).report; };
  ASSERT_TRUE(eventually([&] { return report() && report()->stages.contains("Renderer"); }));
  EXPECT_GT(report()->stages.at("Renderer").cpuNanoseconds, 0);
  EXPECT_GT(report()->residentBytes, 1'000'000U);
  EXPECT_FALSE(report()->memory.empty());
  const auto traces = served->host.nodeTraces(10s);
  ASSERT_EQ(traces.size(), 1U);
  const std::vector<pipeline::TimelineEvent> own = served->host.timeline().events();
  int compared = 0;
  for (const pipeline::TimelineEvent& there : node::eventsOf(*traces[0].trace, traces[0].aheadNanoseconds)) {
    if (there.tag.session == 0) continue;
    const auto isOfItsFrame = [&](const pipeline::TimelineEvent& here) {
      return here.tag.process == there.tag.process && here.tag.session == there.tag.session &&
             here.tag.frame == there.tag.frame;
    };
    const auto first = std::ranges::find_if(own, isOfItsFrame);
    if (first == own.end()) continue;
    ++compared;
    constexpr std::int64_t kRoundTrip = 200'000'000;  // on a busy machine
    EXPECT_GT(there.beginNanoseconds, first->beginNanoseconds - kRoundTrip) << there.stage;
  }
  EXPECT_GT(compared, 0);
}

TEST_F(RemoteNodes, UnreachableNodeIsReported) {
  EXPECT_THAT(errorOf({"127.0.0.1:1"}), HasSubstr("127.0.0.1:1: no node answers"));
}

TEST_F(RemoteNodes, DuplicateObjectIsReported) {
  const auto a = node("mesh");
  const auto b = node("left");
  const std::string error = errorOf({a->address(), b->address()});
  EXPECT_THAT(error, HasSubstr("left is served by the node at "));
  EXPECT_THAT(error, HasSubstr(a->address()));
  EXPECT_THAT(error, HasSubstr(b->address()));
}

TEST_F(RemoteNodes, OtherSceneIsReported) {
  const auto other = node("mesh");
  std::ofstream(file, std::ios::app) << "# another\n";
  const auto changed = node("mesh");
  EXPECT_EQ(errorOf({other->address()}), "");
  EXPECT_THAT(errorOf({changed->address()}), HasSubstr(changed->address() + ": the node refuses: the scenes differ"));
}

TEST_F(RemoteNodes, ServeTwoServers) {
  const auto stones = node("mesh");
  const auto a = serve({stones->address()});
  const auto b = serve({stones->address()}, 2);
  stream::HeadlessSession ada(a->host, "Ada", 160, 90);
  stream::HeadlessSession bob(b->host, "Bob", 160, 90);
  EXPECT_EQ(difference(settled(ada), settled(bob)), 0.0);
}

}  // namespace
}  // namespace grove::integration
