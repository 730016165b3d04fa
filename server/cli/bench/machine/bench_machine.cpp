#include "cli/bench/machine/bench_machine.h"

#include <cstdio>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>

#include "base/simd/target.h"
#include "cli/bench/machine/machine_score.h"
#include "cli/figures.h"
#include "measure/processor.h"

namespace grove::cli {
namespace {

constexpr int kRuns = 25;

}  // namespace

int runBenchMachine(bool json) {
  const std::vector<KernelTime> times = timesOf(machineKernels(), kRuns);
  const MachineScore score = scoreOf(times);
  const std::string processor = measure::processorName();
  const std::string simd = simd::nameOf(simd::currentTarget());
  const unsigned cores = std::thread::hardware_concurrency();
  if (!json) {
    std::printf("%s, %s, %u cores\n\n%-12s %8s %8s %10s\n", processor.c_str(), simd.c_str(), cores, "CPU ms", "hot",
                "cold", "reference");
    for (const KernelTime& time : times) {
      std::printf("%-12s %8.2f %8.2f %10.2f\n", time.name.c_str(), time.hot, time.cold, time.referenceMilliseconds);
    }
    std::printf("\nscore of one core: %.0f (hot %.0f, cold %.0f; the reference core has 100)\n", score.all, score.hot,
                score.cold);
    return 0;
  }
  nlohmann::ordered_json document = {{"score", rounded(score.all, 1)},
                                     {"hot", rounded(score.hot, 1)},
                                     {"cold", rounded(score.cold, 1)},
                                     {"processor", processor},
                                     {"simd", simd},
                                     {"cores", cores},
                                     {"kernels", nlohmann::ordered_json::object()}};
  for (const KernelTime& time : times) {
    document["kernels"][time.name] = {{"hot_cpu_ms", rounded(time.hot, 3)}, {"cold_cpu_ms", rounded(time.cold, 3)}};
  }
  std::printf("%s\n", document.dump(2).c_str());
  return 0;
}

}  // namespace grove::cli
