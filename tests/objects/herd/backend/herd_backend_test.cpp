#include "objects/herd/backend/herd_backend.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <memory>
#include <string>
#include <thread>
#include <variant>

#include "eventually.h"
#include "node/backend/prepare/load_scene.h"
#include "node/backend_stand.h"
#include "objects/herd/backend/herd_backend_type.h"
#include "objects/herd/common/herd_snapshot.h"

namespace grove::objects::herd {
namespace {

using namespace std::chrono_literals;
using tests::eventually;

node::LoadedScene sceneOf(const std::string& settings) {
  node::BackendTypes types;
  types.add(std::make_unique<HerdBackendType>());
  return loadScene(world::parseScene("[[object]]\ntype = 'herd'\n" + settings, "test"), types);
}

/// A world that is nothing but a herd.
class HerdBackendTest : public ::testing::Test {
 protected:
  node::BackendServices services() {
    node::BackendServices services = stand_.services(world_);
    services.announce = [this](const node::Announcement& announcement) { announced_ = announcement.version; };
    return services;
  }

  node::Payload answerTo(bool shared) {
    node::Request request;
    request.object = world_.scene.objects.front().id;
    request.shared = shared;
    node::Payload payload;
    backend_.answer({&request, 1}, {&payload, 1});
    return payload;
  }
  std::shared_ptr<const HerdSnapshot> ask() {
    return std::dynamic_pointer_cast<const HerdSnapshot>(
        std::get<std::shared_ptr<const node::SharedData>>(answerTo(true)));
  }

  void report(std::size_t visitors) {
    const auto update = std::make_shared<node::WorldUpdate>();
    update->number = ++updates_;
    update->clock = 1000.0;
    update->players.resize(visitors);
    for (world::Player& player : update->players) player.pose.position = {60.0F, 1.7F, 60.0F};
    world_.mirror.apply(1, update);
  }

  tests::BackendWorld world_{sceneOf("animals = 5\nposition = [1, 0, 2]\n")};
  tests::BackendStand stand_;
  std::uint64_t updates_ = 0;
  std::atomic<node::Version> announced_ = 0;
  HerdBackend backend_{services(), 0};
};

// Faults: a herd that uses CPU without visitors; one that restarts when a visitor arrives; ticks without an
// announcement.
TEST_F(HerdBackendTest, SleepsWithoutVisitorsAndResumes) {
  const auto ticks = [&] { return stand_.timeline.totals()["Motion Graph Tick"].runs; };
  ASSERT_TRUE(eventually([&] { return ticks() >= 60; }));
  std::this_thread::sleep_for(200ms);
  EXPECT_EQ(ticks(), 60U);
  const auto asleep = ask();
  ASSERT_TRUE(asleep);
  EXPECT_EQ(asleep->animals().size(), 5U);
  EXPECT_TRUE(std::isinf(asleep->time()));

  report(1);
  ASSERT_TRUE(eventually([&] { return ask()->version() > asleep->version() + 10; }));
  const auto awake = ask();
  EXPECT_GE(awake->time(), 1000.0) << "of the world's clock";
  EXPECT_GE(announced_, awake->version());
  const world::Vec3 before = asleep->animals()[0].now.place;
  EXPECT_LT(glm::distance(before, awake->animals()[0].now.place), 12.0F);
  EXPECT_EQ(stand_.timeline.totals()["Motion Graph Tick"].failures, 0U);
}

// Fault: a request that is answered with something else.
TEST_F(HerdBackendTest, ReturnsNoPictures) { EXPECT_TRUE(std::holds_alternative<node::Failure>(answerTo(false))); }

// Faults: settings that are taken as they come; errors that do not say which.
TEST(HerdBackendType, RefusesBadSettings) {
  for (const auto& [settings, word] :
       {std::pair("animals = 0", "animals"), std::pair("animals = 65", "animals"),
        std::pair("animals = 2.5", "animals"), std::pair("range = 1", "range"), std::pair("range = 'far'", "range"),
        std::pair("seed = -1", "seed"), std::pair("colour = 3", "colour"),
        std::pair("[types.herd]\nvariants = 0", "variants"), std::pair("[types.herd]\nvariants = 99", "variants"),
        std::pair("[types.herd]\nclips = 3", "clips")}) {
    try {
      (void)sceneOf(std::string(settings) + "\n");
      ADD_FAILURE() << settings << " is taken";
    } catch (const world::SceneError& e) {
      EXPECT_NE(std::string(e.what()).find(word), std::string::npos) << e.what();
    }
  }
}

}  // namespace
}  // namespace grove::objects::herd
