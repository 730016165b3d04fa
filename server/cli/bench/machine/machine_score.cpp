#include "cli/bench/machine/machine_score.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>

#include "cli/figures.h"
#include "pipeline/clocks.h"

namespace grove::cli {
namespace {

/// More than the caches of any processor here; a core's share of a large one is at most 32 MiB.
constexpr std::size_t kOtherBytes = std::size_t{128} << 20U;
constexpr std::size_t kLine = 64;
constexpr double kMaxSeconds = 2.0;

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

/// Returns the median of at most `runs`; a slow machine or a build with sanitizers makes fewer. Calls `prepare` before
/// each.
double medianTime(const MachineKernel& kernel, int runs, const std::function<void()>& prepare) {
  const double end = pipeline::wallSeconds() + kMaxSeconds;
  std::vector<double> times;
  do {
    prepare();
    times.push_back(timeOf(kernel));
  } while (times.size() < static_cast<std::size_t>(runs) && pipeline::wallSeconds() < end);
  return median(times);
}

}  // namespace

std::vector<KernelTime> timesOf(const std::vector<MachineKernel>& kernels, int runs) {
  OtherMemory other;
  std::vector<KernelTime> times;
  for (const MachineKernel& kernel : kernels) {
    kernel.run();
    const double hot = medianTime(kernel, runs, [] {});
    const double cold = medianTime(kernel, runs, [&] { other.pass(); });
    times.push_back({kernel.name, kernel.referenceMilliseconds, hot, cold});
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
