#include "cli/bench/machine/machine_score.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "cli/program.h"
#include "pipeline/clocks.h"

namespace grove::cli {
namespace {

// Fault: a slow kernel counts more than a fast one.
TEST(MachineScore, IsTheGeometricMeanOfAllKernels) {
  const MachineScore score = scoreOf({{"slow", 100.0, 50.0, 100.0}, {"fast", 1.0, 2.0, 4.0}});
  EXPECT_NEAR(score.hot, 100.0, 1e-9) << "twice as fast and half as fast";
  EXPECT_NEAR(score.cold, 50.0, 1e-9);
  EXPECT_NEAR(score.all, 100.0 / std::sqrt(2.0), 1e-9);
}

// Fault: times of cold runs include the passing of other memory, or runs are not repeated.
TEST(MachineScore, MeasuresOnlyTheKernel) {
  constexpr double kMilliseconds = 3.0;
  int runs = 0;
  const auto burn = [&] {
    ++runs;
    const std::int64_t end = pipeline::threadCpuNanoseconds() + static_cast<std::int64_t>(kMilliseconds * 1e6);
    while (pipeline::threadCpuNanoseconds() < end) continue;
  };
  const auto times = timesOf({{"burn", kMilliseconds, burn}}, 5);
  ASSERT_EQ(times.size(), 1U);
  EXPECT_EQ(runs, 11) << "one to warm up, five hot, five cold";
  EXPECT_GE(times[0].hot, kMilliseconds);
  EXPECT_LT(times[0].hot, 2.0 * kMilliseconds);
  EXPECT_GE(times[0].cold, kMilliseconds);
  EXPECT_LT(times[0].cold, 2.0 * kMilliseconds);
}

// Fault: a kernel that does nothing has no time to compare.
TEST(MachineScore, TheMixTakesTime) {
  for (const KernelTime& time : timesOf(machineKernels(), 1)) {
    EXPECT_GT(time.hot, 0.01) << time.name;
    EXPECT_GT(time.cold, 0.01) << time.name;
    EXPECT_GT(time.referenceMilliseconds, 0.01) << time.name;
  }
}

TEST(BenchMachine, PrintsItsDocument) {
  const Outcome outcome = grove("bench machine --json", false);
  ASSERT_EQ(outcome.exit, 0);
  const auto document = nlohmann::json::parse(outcome.output);
  EXPECT_GT(document.at("score"), 0.0);
  EXPECT_GT(document.at("hot"), 0.0);
  EXPECT_GT(document.at("cold"), 0.0);
  EXPECT_TRUE(document.at("processor").is_string());
  EXPECT_EQ(document.at("kernels").size(), 5U);
}

}  // namespace
}  // namespace grove::cli
