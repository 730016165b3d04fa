#include "cli/bench/capacity/capacity_trial.h"

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <stop_token>

#include "base/error.h"
#include "cli/bench/capacity/server_process.h"
#include "cli/small_scene.h"

namespace grove::cli {
namespace {

class RealServers : public ::testing::Test {
 protected:
  CapacityPlan plan() const {
    CapacityPlan plan;
    plan.scene = scene_.path();
    plan.size = {160, 90};
    plan.seconds = 0.5;
    plan.warmUp = 0.5;
    plan.program = GROVE_BINARY;
    return plan;
  }

 private:
  const SmallScene scene_;
};

/// Would catch private mode with one server, visitors who are all alike, and servers that are not measured.
TEST_F(RealServers, ServeTheSameVisitorsInBothModes) {
  const auto shared = runCapacityTrial(plan(), 2, false, {});
  const auto unshared = runCapacityTrial(plan(), 2, true, {});
  ASSERT_TRUE(shared && unshared);
  for (const auto& trial : {*shared, *unshared}) {
    EXPECT_EQ(trial.load.sessions, 2);
    EXPECT_TRUE(trial.load.errors.empty());
    EXPECT_GT(trial.load.frames, 0U);
    EXPECT_GT(trial.load.latencyP99Milliseconds, 0.0);
    EXPECT_GT(trial.cpuCores, 0.0);
    EXPECT_GT(trial.cpuMillisecondsPerFrame(), 0.0);
  }
  EXPECT_GT(static_cast<double>(unshared->bytes), 1.2 * static_cast<double>(shared->bytes)) << "two processes";
}

TEST_F(RealServers, DoNotStartAfterAStop) {
  std::stop_source stop;
  stop.request_stop();
  EXPECT_FALSE(runCapacityTrial(plan(), 1, false, stop.get_token()));
}

TEST_F(RealServers, EarlyExitIsReported) {
  CapacityPlan wrong = plan();
  wrong.scene = "no/such/scene.toml";
  EXPECT_THROW((void)runCapacityTrial(wrong, 1, false, {}), EnvironmentError);
}

/// Would catch a server that outlives the bench.
TEST_F(RealServers, EndWithTheirOwner) {
  double before = 0.0;
  {
    ServerProcess server(GROVE_BINARY, {"--scene", *plan().scene});
    ASSERT_TRUE(server.awaitPort());
    before = server.cpuSeconds();
    EXPECT_GT(server.proportionalBytes(), 1'000'000);
  }
  EXPECT_GT(before, 0.0);
  EXPECT_EQ(waitpid(-1, nullptr, WNOHANG), -1) << "no child is left";
}

}  // namespace
}  // namespace grove::cli
