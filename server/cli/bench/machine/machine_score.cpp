#include "cli/bench/machine/machine_score.h"

#include <cmath>
#include <cstddef>
#include <cstdint>

#include "cli/figures.h"
#include "pipeline/clocks.h"

namespace grove::cli {
namespace {

/// More than the caches of any processor here; a core's share of a large one is at most 32 MiB.
constexpr std::size_t kOtherBytes = std::size_t{128} << 20U;
constexpr std::size_t kLine = 64;

/// Memory that passes through the caches between two cold runs.
class OtherMemory {
 public:
  void pass() {
    for (std::size_t i = 0; i < bytes_.size(); i += kLine) ++bytes_[i];
  }

 private:
  std::vector<std::uint8_t> bytes_ = std::vector<std::uint8_t>(kOtherBytes);
};

double timeOf(const MachineKernel& kernel) {
  const std::int64_t begin = pipeline::threadCpuNanoseconds();
  kernel.run();
  return static_cast<double>(pipeline::threadCpuNanoseconds() - begin) * 1e-6;
}

}  // namespace

std::vector<KernelTime> timesOf(const std::vector<MachineKernel>& kernels, int runs) {
  OtherMemory other;
  std::vector<KernelTime> times;
  for (const MachineKernel& kernel : kernels) {
    kernel.run();
    std::vector<double> hot;
    std::vector<double> cold;
    hot.reserve(static_cast<std::size_t>(runs));
    cold.reserve(static_cast<std::size_t>(runs));
    for (int i = 0; i < runs; ++i) hot.push_back(timeOf(kernel));
    for (int i = 0; i < runs; ++i) {
      other.pass();
      cold.push_back(timeOf(kernel));
    }
    times.push_back({kernel.name, kernel.referenceMilliseconds, median(hot), median(cold)});
  }
  return times;
}

MachineScore scoreOf(const std::vector<KernelTime>& times) {
  double hot = 0.0;
  double cold = 0.0;
  for (const KernelTime& time : times) {
    hot += std::log(time.referenceMilliseconds / time.hot);
    cold += std::log(time.referenceMilliseconds / time.cold);
  }
  const auto count = static_cast<double>(times.size());
  return {100.0 * std::exp(hot / count), 100.0 * std::exp(cold / count), 100.0 * std::exp(0.5 * (hot + cold) / count)};
}

}  // namespace grove::cli
