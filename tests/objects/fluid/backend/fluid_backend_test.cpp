#include "objects/fluid/backend/fluid_backend.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <cstdint>
#include <string>
#include <thread>
#include <utility>

#include "eventually.h"
#include "gl/workers.h"
#include "node/registry.h"
#include "objects/fluid/backend/fluid_type.h"
#include "objects/fluid/common/snapshot.h"
#include "pipeline/worker_pool.h"
#include "sanitized.h"

namespace grove::objects::fluid {
namespace {

using namespace std::chrono_literals;
using tests::eventually;

/// A world that is nothing but a fire.
class Fire : public ::testing::Test {
 protected:
  explicit Fire(int grid, double tickSeconds = FluidSimulation::kTick)
      : world_(makeWorld(grid)), backend_({world_, workers_, gl_, timeline_, memory_, images_, {}}, 0, tickSeconds) {}

  world::World makeWorld(int grid) {
    registry_.add(std::make_unique<FluidType>());
    const std::string scene = "[[object]]\ntype = 'fluid'\ngrid = " + std::to_string(grid) + "\nsize = 4\nrate = 200\n";
    return world::World(makeLayout(world::parseScene(scene, "test"), registry_));
  }

  /// What a visitor's request is answered with.
  std::shared_ptr<const FluidSnapshot> ask() { return askFrom(backend_); }
  std::shared_ptr<const FluidSnapshot> askFrom(FluidBackend& backend) {
    auto list = std::make_shared<node::FrameList>();
    list->view = std::make_shared<const node::View>();
    list->objects.push_back({world_.objects().front(), {}, 0.0F});
    const node::Request request{list, 0};
    node::Payload payload;
    backend.answer({&request, 1}, {&payload, 1});
    return std::dynamic_pointer_cast<const FluidSnapshot>(
        std::get<std::shared_ptr<const node::SimulationData>>(payload));
  }
  std::uint64_t ticks() { return timeline_.totals()["Simulation Tick"].runs; }

  node::Registry registry_;
  world::World world_;
  pipeline::Timeline timeline_;
  pipeline::MemoryLedger memory_;
  raster::ImagePool images_;
  gl::ShaderLibrary shaders_;
  gl::Workers gl_{gl::ContextKind::kAuto, shaders_, 1};
  pipeline::WorkerPool workers_{1};
  FluidBackend backend_;
};

class FluidBackendTest : public Fire {
 protected:
  FluidBackendTest() : Fire(16) {}
};

/// Where worlds of their own are made for several visitors.
class FluidOfManyWorlds : public Fire {
 protected:
  FluidOfManyWorlds() : Fire(16) {}

  std::shared_ptr<const FluidSnapshot> startOfAnother() {
    steps_ = 0;
    FluidBackend another({.world = world_,
                          .workers = workers_,
                          .gl = gl_,
                          .timeline = timeline_,
                          .memory = memory_,
                          .images = images_,
                          .progress = [this](std::string_view, float) { ++steps_; },
                          .baked = &store_},
                         0);
    return askFrom(another);
  }

  node::BakedStore store_{memory_};
  int steps_ = 0;
};

TEST_F(FluidOfManyWorlds, SmokeRisesOnceForAll) {
  const auto first = startOfAnother();
  EXPECT_GT(steps_, 0) << "before anybody enters";
  const auto second = startOfAnother();
  EXPECT_EQ(steps_, 0);
  for (const auto& start : {first, second}) {
    ASSERT_TRUE(start);
    EXPECT_GT(start->tick, 85U) << "three seconds";
    EXPECT_GT(start->x.size(), 100U);
  }
}

/// On a machine that no tick is short enough for.
class SlowFluidBackendTest : public Fire {
 protected:
  SlowFluidBackendTest() : Fire(16, 1.0e-9) {}
};

TEST_F(SlowFluidBackendTest, ReportsSlowMotion) {
  const auto slowTicks = [&] { return timeline_.counters()["fluid ticks in slow motion"]; };
  EXPECT_TRUE(eventually([&] { return slowTicks() > 0; }));
  EXPECT_TRUE(eventually([&] { return slowTicks() <= static_cast<std::int64_t>(ticks()); }))
      << "a tick is counted as a run when it has ended";
}

TEST_F(FluidBackendTest, RestsWithoutVisitorsAndGoesOnWhereItWas) {
  ASSERT_TRUE(eventually([&] { return ticks() >= 60; }));
  std::this_thread::sleep_for(300ms);
  EXPECT_EQ(ticks(), 60U) << "two seconds";

  world_.players().join("first", world::World::now());
  const auto first = ask();
  ASSERT_TRUE(first);
  EXPECT_GT(first->count(), 100U) << "the first visitor meets a grown plume";
  EXPECT_TRUE(std::isinf(first->time)) << "that nobody moves on: it stands since long ago";
  const std::uint64_t before = first->tick;
  auto next = first;
  ASSERT_TRUE(eventually([&] { return (next = ask())->tick != before; }));
  EXPECT_EQ(next->tick, before + 1) << "simulated time goes on where it was";
  EXPECT_TRUE(std::isfinite(next->time));

  // The grid changes while it ticks and while visitors ask: time and smoke go on.
  auto last = ask();
  for (int i = 0; i < (kSanitized ? 6 : 12); ++i) {
    const std::uint64_t until = last->tick + 4;
    backend_.setQuality(i % (node::kMostQuality + 1));
    const auto reached = [&] {
      const auto former = std::exchange(last, ask());
      EXPECT_GE(last->tick, former->tick) << "time never starts anew";
      EXPECT_GT(last->count(), 100U);
      return last->tick >= until;
    };
    ASSERT_TRUE(eventually(reached));
  }
  EXPECT_EQ(timeline_.totals()["Simulation Tick"].failures, 0U);

  // As long as somebody is here, wherever they look.
  EXPECT_TRUE(eventually([&] { return ticks() >= 60 + 65; }));
}

}  // namespace
}  // namespace grove::objects::fluid
