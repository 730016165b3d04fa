#include "pipeline/run_all.h"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <vector>

#include "pipeline/worker_pool.h"

namespace grove::pipeline {
namespace {

TEST(RunAll, CallsEachOnceAndWaits) {
  WorkerPool pool(3);
  std::vector<std::atomic<int>> calls(1000);
  runAll(pool, calls.size(), [&](std::size_t i) { ++calls[i]; });
  for (const auto& count : calls) EXPECT_EQ(count, 1);
  runAll(pool, 0, [](std::size_t) { FAIL(); });
}

TEST(RunAll, RethrowsHereWhatACallThrows) {
  WorkerPool pool(2);
  std::atomic<int> calls = 0;
  const auto all = [&] {
    runAll(pool, 1000, [&](std::size_t i) {
      ++calls;
      if (i == 10) throw std::runtime_error("ten");
    });
  };
  EXPECT_THROW(all(), std::runtime_error);
  EXPECT_LT(calls, 1000);
}

/// An executor that takes one task and then has no memory for more.
class Short final : public Executor {
 public:
  [[nodiscard]] int width() const noexcept override { return 3; }

 private:
  void enqueue(std::function<void()> task) override {
    if (std::exchange(taken_, true)) throw std::bad_alloc();
    pool_.post(std::move(task));
  }
  bool taken_ = false;
  WorkerPool pool_{1};
};

TEST(RunAll, WaitsForWhatWasPostedIfTheRestCannotBe) {
  Short executor;
  EXPECT_THROW(runAll(executor, 1000, [](std::size_t) {}), std::bad_alloc);
}

}  // namespace
}  // namespace grove::pipeline
