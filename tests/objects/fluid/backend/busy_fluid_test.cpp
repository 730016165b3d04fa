#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>

#include "eventually.h"
#include "objects/fluid/backend/fire_fixture.h"

namespace grove::objects::fluid {
namespace {

using tests::eventually;

class BusyFluid : public Fire {
 protected:
  BusyFluid() : Fire(16) {}
};

/// Keeps a worker busy.
class BusyWorker {
 public:
  explicit BusyWorker(pipeline::Executor& workers) {
    workers.post([stop = stop_] {
      while (!*stop) {
      }
    });
  }
  ~BusyWorker() { *stop_ = true; }
  BusyWorker(const BusyWorker&) = delete;
  BusyWorker& operator=(const BusyWorker&) = delete;

 private:
  const std::shared_ptr<std::atomic<bool>> stop_ = std::make_shared<std::atomic<bool>>(false);
};

/// Fails if a machine at its limit simulates as often as others, or if its smoke moves in slow motion.
TEST_F(BusyFluid, HalvesItsRateAndDoublesItsStep) {
  report(1);
  const auto ageOf = [](const FluidSnapshot& snapshot, float lifetime) -> std::optional<float> {
    const auto found = std::ranges::find(snapshot.lifetime, lifetime);
    if (found == snapshot.lifetime.end()) return std::nullopt;
    return snapshot.age[static_cast<std::size_t>(found - snapshot.lifetime.begin())];
  };
  const auto secondsInTicks = [&](std::uint64_t count) {
    const auto first = ask();
    EXPECT_TRUE(eventually([&] { return ask()->tick >= first->tick + count; }));
    const auto last = ask();
    const auto age = ageOf(*last, first->lifetime.back());
    EXPECT_TRUE(age) << "the youngest particle lives for longer";
    return (age.value_or(0.0F) - first->age.back()) / static_cast<float>(last->tick - first->tick);
  };
  EXPECT_NEAR(secondsInTicks(4), FluidSimulation::kTick, 1.0e-3F);
  const BusyWorker busy(workers_);
  ASSERT_TRUE(eventually([&] { return workers_.busyShare() > 0.99; }));
  const std::uint64_t tick = ask()->tick;
  ASSERT_TRUE(eventually([&] { return ask()->tick > tick; })) << "the one under way";
  EXPECT_NEAR(secondsInTicks(4), 2.0F * FluidSimulation::kTick, 1.0e-3F);
}

}  // namespace
}  // namespace grove::objects::fluid
