#include "stream/session/frame_gate.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <thread>
#include <vector>

namespace grove::stream {
namespace {

using ::testing::ElementsAre;

TEST(FrameGate, AdmitsIdleCapacityThenInOrder) {
  FrameGate gate(3);
  std::vector<int> turns;
  const auto wait = [&](int who) {
    return !gate.enter([&turns, who] {
      turns.push_back(who);
      return true;
    });
  };
  EXPECT_TRUE(wait(0)) << "no worker is idle yet";
  gate.workerIs(true);
  EXPECT_THAT(turns, ElementsAre(0));
  EXPECT_FALSE(wait(1)) << "it is idle still";
  gate.workerIs(false);
  EXPECT_TRUE(wait(2));
  EXPECT_TRUE(wait(3));
  gate.leave();
  EXPECT_THAT(turns, ElementsAre(0)) << "a place alone is not enough";
  gate.workerIs(true);
  EXPECT_THAT(turns, ElementsAre(0, 2));
  gate.workerIs(true);
  EXPECT_THAT(turns, ElementsAre(0, 2, 3)) << "one for each that becomes idle";
}

TEST(FrameGate, LimitsFramesInProgress) {
  FrameGate gate(2);
  gate.workerIs(true);
  std::vector<int> turns;
  EXPECT_TRUE(gate.enter({}));
  EXPECT_TRUE(gate.enter({}));
  for (int i = 0; i < 3; ++i) {
    EXPECT_FALSE(gate.enter([&turns, i] {
      turns.push_back(i);
      return true;
    }));
  }
  gate.workerIs(true);
  EXPECT_TRUE(turns.empty());
  gate.leave();
  gate.leave();
  EXPECT_THAT(turns, ElementsAre(0, 1));
  EXPECT_FALSE(gate.enter([&turns] {
    turns.push_back(3);
    return true;
  })) << "no place was left by those who took their turns";
  for (int i = 0; i < 2; ++i) gate.leave();
  EXPECT_THAT(turns, ElementsAre(0, 1, 2, 3));
  for (int i = 0; i < 2; ++i) gate.leave();
  EXPECT_TRUE(gate.enter({}));
}

/// Fails if a session that has ended while it waited keeps a place.
TEST(FrameGate, UnusedTurnsGoToTheNext) {
  FrameGate gate(1);
  gate.workerIs(true);
  ASSERT_TRUE(gate.enter({}));
  int turns = 0;
  for (int i = 0; i < 2; ++i) {
    EXPECT_FALSE(gate.enter([] { return false; }));
  }
  EXPECT_FALSE(gate.enter([&turns] { return ++turns > 0; }));
  gate.leave();
  EXPECT_EQ(turns, 1);
  EXPECT_FALSE(gate.enter([] { return false; })) << "the third has the place";
  gate.leave();
  EXPECT_TRUE(gate.enter({})) << "and the last did not keep it";
}

/// Fails if a place is lost or doubled, or somebody waits for ever.
TEST(FrameGate, PlacesStayConsistentUnderManyThreads) {
  constexpr int kPlaces = 3;
  constexpr int kThreads = 8;
  constexpr int kTurns = 2000;
  FrameGate gate(kPlaces);
  gate.workerIs(true);
  std::atomic<int> inside{0};
  std::atomic<int> max{0};
  std::atomic<int> done{0};
  const auto work = [&] {
    const int now = ++inside;
    for (int seen = max; seen < now && !max.compare_exchange_weak(seen, now);) {
    }
    --inside;
    ++done;
  };
  std::vector<std::jthread> threads;
  threads.reserve(kThreads);
  for (int t = 0; t < kThreads; ++t) {
    threads.emplace_back([&] {
      for (int i = 0; i < kTurns; ++i) {
        std::atomic<bool> turn{false};
        if (!gate.enter([&turn] { return turn = true; })) {
          while (!turn) std::this_thread::yield();
        }
        work();
        gate.leave();
      }
    });
  }
  std::atomic<bool> over{false};
  std::jthread worker([&] {
    while (!over) {
      gate.workerIs(false);
      std::this_thread::yield();
      gate.workerIs(true);
    }
  });
  threads.clear();
  over = true;
  worker.join();
  EXPECT_EQ(done, kThreads * kTurns);
  EXPECT_LE(max, kPlaces);
  for (int i = 0; i < kPlaces; ++i) EXPECT_TRUE(gate.enter({}));
  EXPECT_FALSE(gate.enter([] { return true; }));
}

}  // namespace
}  // namespace grove::stream
