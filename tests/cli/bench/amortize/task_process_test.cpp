#include "cli/bench/amortize/task_process.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <deque>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <thread>

namespace grove::cli {
namespace {

using Text = std::optional<std::string>;

// Fault: a result that does not fit into a socket's buffer is cut off.
TEST(TaskProcess, SendsAResultOfAnySize) {
  Interruption interruption;
  TaskProcess process(
      [](const TaskProcess::Parent&, const std::stop_token&) { return Text(std::string(5'000'000, 'a')); });
  EXPECT_EQ(process.awaitResult(interruption), std::string(5'000'000, 'a'));
}

// Fault: processes that are to measure the same seconds do not wait for the slowest one.
TEST(TaskProcess, BarrierReleasesAll) {
  using Clock = std::chrono::steady_clock;  // is the same for all processes of a machine
  Interruption interruption;
  std::deque<TaskProcess> processes;
  for (const int milliseconds : {0, 200}) {
    processes.emplace_back([milliseconds](const TaskProcess::Parent& parent, const std::stop_token&) -> Text {
      std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
      const auto arrival = Clock::now().time_since_epoch().count();
      if (!parent.arrive()) return std::nullopt;
      return std::to_string(arrival) + " " + std::to_string(Clock::now().time_since_epoch().count());
    });
  }
  for (TaskProcess& process : processes) ASSERT_TRUE(process.awaitArrival(interruption));
  for (const TaskProcess& process : processes) process.proceed();
  std::int64_t lastArrival = 0;
  std::int64_t firstDeparture = std::numeric_limits<std::int64_t>::max();
  for (TaskProcess& process : processes) {
    std::istringstream times(process.awaitResult(interruption).value_or(""));
    std::int64_t arrival = 0;
    std::int64_t departure = 0;
    ASSERT_TRUE(times >> arrival >> departure);
    lastArrival = std::max(lastArrival, arrival);
    firstDeparture = std::min(firstDeparture, departure);
  }
  EXPECT_LT(lastArrival, firstDeparture);
}

TEST(TaskProcess, RethrowsWhatTheTaskThrows) {
  Interruption interruption;
  TaskProcess process(
      [](const TaskProcess::Parent&, const std::stop_token&) -> Text { throw std::runtime_error("no fire"); });
  try {
    (void)process.awaitResult(interruption);
    FAIL() << "nothing was thrown";
  } catch (const std::runtime_error& e) {
    EXPECT_STREQ(e.what(), "no fire");
  }
}

// Fault: a process that is killed, for example for want of memory, leaves its parent waiting.
TEST(TaskProcess, ReportsAProcessThatIsKilled) {
  Interruption interruption;
  TaskProcess process([](const TaskProcess::Parent&, const std::stop_token&) -> Text {
    raise(SIGKILL);
    return std::nullopt;
  });
  EXPECT_THROW((void)process.awaitResult(interruption), std::runtime_error);
}

// Fault: a signal to a group of processes that the task gets first is not seen as the end of the bench.
TEST(TaskProcess, EndsWithATaskThatWasStopped) {
  Interruption interruption;
  TaskProcess process([](const TaskProcess::Parent&, const std::stop_token&) -> Text { return std::nullopt; });
  EXPECT_FALSE(process.awaitResult(interruption));
  EXPECT_TRUE(interruption.hasCome());
}

// Fault: a signal that only the bench's own process gets does not end it, or leaves its copies behind.
TEST(TaskProcess, EndsAfterASignal) {
  Interruption interruption;
  TaskProcess process([](const TaskProcess::Parent&, const std::stop_token& stop) -> Text {
    while (!stop.stop_requested()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    return std::nullopt;
  });
  raise(SIGTERM);
  raise(SIGINT);  // stays pending, and must not end this process later
  EXPECT_FALSE(process.awaitResult(interruption));
  EXPECT_TRUE(interruption.hasCome());
}

}  // namespace
}  // namespace grove::cli
