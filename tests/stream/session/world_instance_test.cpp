#include "stream/session/world_instance.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include "eventually.h"
#include "gl/shader_library.h"
#include "gl/workers.h"
#include "node/local/local_world.h"
#include "pipeline/clocks.h"
#include "stream/session/headless_session.h"
#include "stream/session/host.h"
#include "stream/session/watchers.h"

namespace grove::stream {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using testing::Sight;
using testing::watchedScene;
using testing::watchers;
using tests::eventually;

constexpr auto kPatience = std::chrono::seconds(30);

class WorldInstanceTest : public ::testing::Test {
 protected:
  Sight sight_;
  const node::ObjectTypes types_ = watchers(sight_);
  gl::ShaderLibrary shaders_;
  gl::Workers gl_{gl::ContextKind::kAuto, shaders_, 1};
  Host host_{
      node::localWorld(watchedScene(types_), types_.backends, gl_), types_.frontends, {}, [](std::string_view, float) {
      }};
};

TEST_F(WorldInstanceTest, ReportsVisitorsToItsBackend) {
  ASSERT_NE(sight_.world, nullptr);
  EXPECT_THAT(sight_.names(), IsEmpty());
  {
    HeadlessSession ada(host_, "Ada", 160, 90);
    EXPECT_TRUE(eventually([&] { return sight_.names() == std::vector<std::string>{"Ada"}; }));
    const HeadlessSession bob(host_, "Bob", 160, 90);
    EXPECT_TRUE(eventually([&] { return sight_.names().size() == 2; }));
    const int before = sight_.wakes;
    EXPECT_TRUE(eventually([&] { return sight_.wakes >= before + 3; })) << "again and again";
    ada.control(world::kForward, 0.0F, 0.0F);
    const world::Vec3 start = sight_.world->players().at(0).pose.position;
    EXPECT_TRUE(eventually([&] { return sight_.world->players().at(0).pose.position != start; }));
  }
  EXPECT_TRUE(eventually([&] { return sight_.names().empty(); }));
  const int rest = sight_.wakes;
  host_.workers().drain();
  EXPECT_EQ(sight_.wakes, rest) << "nobody is there";
}

TEST_F(WorldInstanceTest, ReportsGustsToItsBackend) {
  HeadlessSession ada(host_, "Ada", 160, 90);
  node::WorldMirror::Cursor cursor = 0;
  ASSERT_TRUE(eventually([&] { return !sight_.names().empty(); }));
  EXPECT_THAT(sight_.world->gusts(cursor), IsEmpty());
  ada.control(world::kBlow, 0.0F, 0.0F);
  EXPECT_TRUE(eventually([&] { return sight_.world->gusts(cursor).size() == 1; }));
  ada.control(0, 0.0F, 0.0F);
  EXPECT_TRUE(eventually([&] { return sight_.world->gusts(cursor).empty(); }));
  // A breath between two updates.
  ada.control(world::kBlow, 0.0F, 0.0F);
  ada.control(0, 0.0F, 0.0F);
  EXPECT_TRUE(eventually([&] { return sight_.world->gusts(cursor).size() == 1; }));
}

TEST_F(WorldInstanceTest, ReportsDeparturesToItsBackend) {
  { const HeadlessSession ada(host_, "Ada", 160, 90); }
  const auto forgotten = [&] {
    const std::lock_guard lock(sight_.mutex);
    return sight_.forgotten;
  };
  EXPECT_TRUE(eventually([&] { return !forgotten().empty(); }));
  EXPECT_THAT(forgotten(), ElementsAre(node::makeId(1, 1)));
}

TEST_F(WorldInstanceTest, PagesSeeLowIds) {
  HeadlessSession ada(host_, "", 160, 90);
  ASSERT_TRUE(ada.frameAfter(0, kPatience));
  EXPECT_EQ(ada.welcome().visitor, 1U);
  EXPECT_EQ(host_.players().all(pipeline::wallSeconds()).at(0).name, "Visitor 1");
  for (const pipeline::TimelineEvent& event : host_.timeline().events()) EXPECT_LE(event.tag.session, 1U);
}

TEST(WorldInstance, SetsTheQualityOfItsBackend) {
  Sight sight;
  const node::ObjectTypes types = watchers(sight);
  const gl::ShaderLibrary shaders;
  gl::Workers gl(gl::ContextKind::kAuto, shaders, 1);
  pipeline::Timeline timeline;
  pipeline::MemoryLedger memory;
  raster::ImagePool images;
  pipeline::WorkerPool workers(2);
  const node::Machine machine{workers, timeline, memory, images};
  node::LocalWorld nodes(watchedScene(types), types.backends, gl, machine, {});
  WorldInstance instance({nodes, world::World::makePlayers(nodes.layout()), types.frontends, machine, 0, 1});
  instance.setQuality(2);
  EXPECT_EQ(sight.quality, 2);
}

}  // namespace
}  // namespace grove::stream
