#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "eventually.h"
#include "gl/shader_library.h"
#include "gl/workers.h"
#include "node/local/local_world.h"
#include "node/transport/bytes_transport.h"
#include "node/world/world_owner.h"
#include "pipeline/clocks.h"
#include "stream/session/headless_session.h"
#include "stream/session/host.h"
#include "stream/session/watchers.h"

namespace grove::stream {
namespace {

using ::testing::UnorderedElementsAre;
using testing::watchedScene;
using State = node::JoinedWorld::State;
using tests::eventually;

/// A server that shows a world which another process owns.
class JoinedHost {
 public:
  JoinedHost(node::ProcessId process, node::WorldOwner& owner, gl::Workers& gl) : types_(testing::watchers(sight_)) {
    HostOptions options;
    options.process = process;
    options.linkToOwner = [&](pipeline::Executor& workers, pipeline::Timeline& timeline) {
      auto link = std::make_shared<node::BytesTransport>(workers, timeline);
      served_ = owner.accept(link);
      return link;
    };
    host_ = std::make_unique<Host>(node::localWorld(watchedScene(types_), types_.backends, gl), types_.frontends,
                                   options, [](std::string_view, float) {});
  }
  ~JoinedHost() { leave(); }
  JoinedHost(const JoinedHost&) = delete;
  JoinedHost& operator=(const JoinedHost&) = delete;

  /// The owner is heard no more, as if it had died.
  void leave() { served_.reset(); }

  [[nodiscard]] Host& host() { return *host_; }
  [[nodiscard]] testing::Sight& sight() { return sight_; }
  [[nodiscard]] State state() const { return host_->joined()->state; }
  /// Of whom its own backend node knows.
  [[nodiscard]] std::vector<std::string> known() const { return sight_.names(); }

 private:
  testing::Sight sight_;
  const node::ObjectTypes types_;
  std::unique_ptr<Host> host_;
  std::shared_ptr<void> served_;
};

class JoinedHosts : public ::testing::Test {
 protected:
  gl::ShaderLibrary shaders_;
  gl::Workers gl_{gl::ContextKind::kAuto, shaders_, 1};
  node::WorldOwner owner_{watchedScene(testing::watchers(unused_)).layout.hash, 30.0F};

 private:
  testing::Sight unused_;
};

TEST_F(JoinedHosts, BackendsKnowVisitorsOfBothHosts) {
  JoinedHost a(1, owner_, gl_);
  JoinedHost b(2, owner_, gl_);
  const HeadlessSession ann(a.host(), "Ann", 160, 90);
  {
    const HeadlessSession bob(b.host(), "Bob", 160, 90);
    const auto areBoth = [](const std::vector<std::string>& names) { return names.size() == 2; };
    EXPECT_TRUE(eventually([&] { return areBoth(a.known()) && areBoth(b.known()); }));
    EXPECT_THAT(a.known(), UnorderedElementsAre("Ann", "Bob"));
    EXPECT_THAT(b.known(), UnorderedElementsAre("Ann", "Bob"));
    EXPECT_NE(ann.welcome().colour, 0U);
  }
  EXPECT_TRUE(eventually([&] { return a.known() == std::vector<std::string>{"Ann"}; })) << "Bob has left";
  EXPECT_TRUE(eventually([&] { return b.known() == std::vector<std::string>{"Ann"}; })) << "from his own server, too";
}

TEST_F(JoinedHosts, GustsReachSimulationsOfTheOther) {
  JoinedHost a(1, owner_, gl_);
  JoinedHost b(2, owner_, gl_);
  HeadlessSession ann(a.host(), "Ann", 160, 90);
  const HeadlessSession bob(b.host(), "Bob", 160, 90);
  ASSERT_TRUE(eventually([&] { return b.known().size() == 2; }));
  node::WorldMirror::Cursor cursor = 0;
  ann.control(world::kBlow, 0.0F, 0.0F);
  EXPECT_TRUE(eventually([&] { return b.sight().world->gusts(cursor).size() == 1; }));
  ann.control(0, 0.0F, 0.0F);
  EXPECT_TRUE(eventually([&] { return b.sight().world->gusts(cursor).empty(); }));
}

/// Would catch a server that freezes, or drops its visitors, with the owner.
TEST_F(JoinedHosts, ContinuesWithoutTheOwner) {
  JoinedHost a(1, owner_, gl_);
  HeadlessSession ann(a.host(), "Ann", 160, 90);
  ASSERT_TRUE(eventually([&] { return a.known().size() == 1; }));
  ASSERT_TRUE(eventually([&] { return a.state() == State::kJoined; }));
  a.leave();
  EXPECT_TRUE(eventually([&] { return a.state() == State::kLost; }));
  ann.control(world::kForward, 0.0F, 0.0F);
  const world::Vec3 start = a.sight().world->players().at(0).pose.position;
  EXPECT_TRUE(eventually([&] { return a.sight().world->players().at(0).pose.position != start; }));
  EXPECT_FALSE(ann.session().refusal());
}

}  // namespace
}  // namespace grove::stream
