#include "objects/fluid/backend/fluid_backend.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <memory>
#include <string>
#include <thread>
#include <utility>

#include "eventually.h"
#include "objects/fluid/backend/fire_fixture.h"
#include "objects/fluid/common/snapshot_packing.h"
#include "sanitized.h"

namespace grove::objects::fluid {
namespace {

using namespace std::chrono_literals;
using tests::eventually;

class FluidBackendTest : public Fire {
 protected:
  FluidBackendTest() : Fire(16) {}
};

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

TEST_F(FluidBackendTest, PausesWithoutVisitorsAndResumes) {
  ASSERT_TRUE(eventually([&] { return ticks() >= 60; }));
  std::this_thread::sleep_for(300ms);
  EXPECT_EQ(ticks(), 60U) << "two seconds";

  const auto first = ask();
  ASSERT_TRUE(first);
  EXPECT_GT(first->count(), 100U) << "the first visitor meets a grown plume";
  EXPECT_TRUE(std::isinf(first->time)) << "that nobody moves on: it stands since long ago";
  EXPECT_EQ(announced_, first->version());
  report(0);
  std::this_thread::sleep_for(100ms);
  EXPECT_EQ(ticks(), 60U) << "nobody came";

  report(1);
  const std::uint64_t before = first->tick;
  auto next = first;
  ASSERT_TRUE(eventually([&] { return (next = ask())->tick != before; }));
  EXPECT_EQ(next->tick, before + 1) << "simulated time goes on where it was";
  EXPECT_GE(next->time, kClock) << "of the world's clock";
  EXPECT_LT(next->time, kClock + 600.0);

  // The grid changes while it ticks and while frontends ask: time and smoke go on.
  auto last = ask();
  for (int i = 0; i < (kSanitized ? 6 : 12); ++i) {
    const std::uint64_t until = last->tick + 4;
    backend_.setQuality(i % (node::kMaxQuality + 1));
    const auto reached = [&] {
      const auto former = std::exchange(last, ask());
      EXPECT_GE(last->tick, former->tick) << "time never starts anew";
      EXPECT_EQ(last->version(), last->tick);
      EXPECT_GT(last->count(), 100U);
      return last->tick >= until;
    };
    ASSERT_TRUE(eventually(reached));
  }
  EXPECT_EQ(timeline_.totals()["Simulation Tick"].failures, 0U);

  // As long as somebody is here, wherever they look.
  EXPECT_TRUE(eventually([&] { return ticks() >= 60 + 65; }));

  report(0);
  EXPECT_TRUE(eventually([&] { return std::isinf(ask()->time); })) << "all have left";
}

TEST_F(FluidBackendTest, AnnouncesTheVersionItAnswersWith) {
  report(1);
  for (int i = 0; i < 5; ++i) {
    const node::Version before = announced_;
    ASSERT_TRUE(eventually([&] { return announced_ > before; }));
    const node::Version announced = announced_;
    EXPECT_GE(ask()->version(), announced);
  }
}

/// Whose frontend processes are on other machines.
class RemoteFluidBackendTest : public Fire {
 protected:
  RemoteFluidBackendTest() : Fire(16) {}

  std::shared_ptr<const node::SharedData> askKnowing(node::Version known) {
    return std::get<std::shared_ptr<const node::SharedData>>(answerTo(backend_, fire(), true, known));
  }
  node::PackedBytes packed(const node::SharedData& data) { return *data.packed(timeline_, "fluid"); }
};

TEST_F(RemoteFluidBackendTest, SendsDifferencesToRecentTicks) {
  report(1);
  bool isFound = false;
  for (int i = 0; i < 50 && !isFound; ++i) {
    const auto known = ask();
    ASSERT_TRUE(eventually([&] { return announced_ > known->version(); }));
    const auto change = askKnowing(known->version());
    const auto whole = ask();
    // On a machine that is busy the next tick may come in between.
    if (whole->version() != change->version() || change == whole) continue;
    isFound = true;
    EXPECT_EQ(askKnowing(known->version()), change) << "packed once for all who know that tick";
    const node::PackedBytes bytes = packed(*change);
    EXPECT_LT(bytes.size(), packed(*whole).size() / 2);
    const auto travelled = unpackSnapshot(packed(*known));
    const auto result = unpackSnapshot(bytes, travelled.get());
    const auto expected = unpackSnapshot(packed(*whole));
    EXPECT_EQ(result->tick, whole->tick);
    EXPECT_EQ(result->x, expected->x);
    EXPECT_EQ(result->age, expected->age);
    EXPECT_EQ(result->sunLight, expected->sunLight);
  }
  EXPECT_TRUE(isFound);
}

TEST_F(RemoteFluidBackendTest, SendsTheWholeOtherwise) {
  report(1);
  const node::Version first = ask()->version();
  ASSERT_TRUE(eventually([&] { return announced_ > first + 40; }));
  for (const node::Version known : {node::Version{0}, first, announced_ + 1000}) {
    EXPECT_TRUE(std::dynamic_pointer_cast<const FluidSnapshot>(askKnowing(known))) << known;
  }
}

/// Or a world in one process would hold half a second of smoke for nobody.
TEST_F(RemoteFluidBackendTest, KeepsNoHistoryWithoutNeed) {
  report(1);
  for (int i = 0; i < 2; ++i) {
    const auto known = ask();
    const node::Version later = known->version() + 20;
    ASSERT_TRUE(eventually([&] { return announced_ > later; }));
    const auto recent = ask();
    ASSERT_TRUE(eventually([&] { return announced_ > recent->version(); }));
    EXPECT_TRUE(std::dynamic_pointer_cast<const FluidSnapshot>(askKnowing(recent->version()))) << "nor again";
  }
}

TEST_F(FluidBackendTest, RefusesPicturesAndOtherObjects) {
  EXPECT_TRUE(std::holds_alternative<node::Failure>(answerTo(backend_, fire(), false)));
  EXPECT_TRUE(std::holds_alternative<node::Failure>(answerTo(backend_, fire() + 1, true)));
}

}  // namespace
}  // namespace grove::objects::fluid
