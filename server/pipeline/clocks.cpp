#include "pipeline/clocks.h"

#include <ctime>

namespace grove::pipeline {
namespace {

std::int64_t read(clockid_t clock) noexcept {
  timespec t{};
  clock_gettime(clock, &t);
  return std::int64_t{t.tv_sec} * 1'000'000'000 + t.tv_nsec;
}

}  // namespace

std::int64_t wallNanoseconds() noexcept { return read(CLOCK_MONOTONIC); }
std::int64_t threadCpuNanoseconds() noexcept { return read(CLOCK_THREAD_CPUTIME_ID); }
std::int64_t processCpuNanoseconds() noexcept { return read(CLOCK_PROCESS_CPUTIME_ID); }

}  // namespace grove::pipeline
