#include "measure/thread_times.h"

#include <gtest/gtest.h>
#include <pthread.h>

#include <atomic>
#include <latch>
#include <thread>

#include "pipeline/clocks.h"

namespace grove::measure {
namespace {

TEST(ThreadTimes, SumsByThreadName) {
  constexpr double kBurnt = 0.05;
  std::latch burnt(1);
  std::latch read(1);
  const ThreadTimes before = ThreadTimes::read();
  std::thread burner([&] {
    pthread_setname_np(pthread_self(), "burner-7");
    const std::int64_t begin = pipeline::threadCpuNanoseconds();
    while (static_cast<double>(pipeline::threadCpuNanoseconds() - begin) < kBurnt * 1e9) {
    }
    burnt.count_down();
    read.wait();
  });
  burnt.wait();
  const ThreadTimes after = ThreadTimes::read();
  read.count_down();
  burner.join();
  EXPECT_GE(after.secondsSince(before, "burner"), 0.9 * kBurnt) << "the kernel's two clocks differ a little";
  EXPECT_LE(after.secondsSince(before, "burner"), 1.5 * kBurnt);
  EXPECT_GE(after.secondsSince(before, ""), after.secondsSince(before, "burner"));
  EXPECT_EQ(after.secondsSince(before, "llvmpipe"), 0.0);
  EXPECT_EQ(after.secondsSince(after, "burner"), 0.0);
}

}  // namespace
}  // namespace grove::measure
