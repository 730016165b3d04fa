#include "stream/load/input_clock.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <poll.h>

#include <algorithm>
#include <thread>

namespace grove::stream {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

/// Those that the clock names at its next wake-up.
std::vector<int> nextDue(InputClock& clock, int descriptor) {
  pollfd polled{descriptor, POLLIN, 0};
  EXPECT_EQ(poll(&polled, 1, 5000), 1);
  return clock.takeDue();
}

TEST(InputClock, NamesEachSessionInTurn) {
  InputClock clock(3, 600ms);
  const Descriptor descriptor(clock.duplicate());
  const auto began = std::chrono::steady_clock::now();
  for (const int session : {0, 1, 2, 0}) EXPECT_THAT(nextDue(clock, descriptor.get()), ElementsAre(session));
  EXPECT_GE(std::chrono::steady_clock::now() - began, 800ms) << "they are spread over the period";
}

TEST(InputClock, IsNotReadableBetweenTurns) {
  InputClock clock(1, 900ms);
  const Descriptor descriptor(clock.duplicate());
  EXPECT_THAT(nextDue(clock, descriptor.get()), ElementsAre(0));
  pollfd polled{descriptor.get(), POLLIN, 0};
  EXPECT_EQ(poll(&polled, 1, 0), 0);
  EXPECT_THAT(clock.takeDue(), IsEmpty());
}

TEST(InputClock, ReportsLaggingSessionsOnce) {
  InputClock clock(5, 10ms);
  std::this_thread::sleep_for(100ms);
  std::vector<int> due = clock.takeDue();
  std::ranges::sort(due);
  EXPECT_THAT(due, ElementsAre(0, 1, 2, 3, 4));
}

/// No more than one wake-up a millisecond, and still everybody.
TEST(InputClock, SharesTurnsAmongManySessions) {
  InputClock clock(7, 3ms);
  std::this_thread::sleep_for(100ms);
  EXPECT_THAT(clock.takeDue(), SizeIs(7));
  InputClock slow(7, 3ms);
  const Descriptor descriptor(slow.duplicate());
  const std::vector<int> first = nextDue(slow, descriptor.get());
  EXPECT_THAT(std::vector<int>(first.begin(), first.begin() + 3), ElementsAre(0, 3, 6));
}

}  // namespace
}  // namespace grove::stream
