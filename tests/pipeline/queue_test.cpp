#include "pipeline/queue.h"

#include <gtest/gtest.h>

#include <memory>
#include <thread>
#include <vector>

namespace grove::pipeline {
namespace {

TEST(Queue, KeepsOrderAndRejectsWhenFull) {
  Queue<int> queue(2, Overflow::kReject);
  EXPECT_EQ(queue.push(1), PushResult::kAccepted);
  EXPECT_EQ(queue.push(2), PushResult::kAccepted);
  EXPECT_EQ(queue.push(3), PushResult::kRejected);
  EXPECT_EQ(queue.pop(), 1);
  EXPECT_EQ(queue.pop(), 2);
  EXPECT_EQ(queue.pop(), std::nullopt);
}

TEST(Queue, NewestWinsDropsTheOldest) {
  Queue<int> queue(2, Overflow::kDropOldest);
  queue.push(1);
  queue.push(2);
  EXPECT_EQ(queue.push(3), PushResult::kDroppedOldest);
  EXPECT_EQ(queue.pop(), 2);
  EXPECT_EQ(queue.pop(), 3);
}

TEST(Queue, ReservedRoomIsCountedAndReturned) {
  Queue<int> queue(1, Overflow::kReject);
  int calls = 0;
  ASSERT_TRUE(queue.tryReserve({}));
  EXPECT_EQ(queue.push(7), PushResult::kRejected);
  EXPECT_FALSE(queue.tryReserve([&] { ++calls; }));
  queue.cancelReservation();
  EXPECT_EQ(calls, 1);
  ASSERT_TRUE(queue.tryReserve({}));
  EXPECT_EQ(queue.pushReserved(8), PushResult::kAccepted);
  EXPECT_EQ(queue.pop(), 8);
}

TEST(Queue, ClosingDropsValuesAndWakesWaiters) {
  auto value = std::make_shared<int>(5);
  Queue<std::shared_ptr<int>> queue(1, Overflow::kReject);
  queue.push(value);
  int calls = 0;
  EXPECT_FALSE(queue.tryReserve([&] { ++calls; }));
  queue.close();
  EXPECT_EQ(calls, 1);
  EXPECT_EQ(value.use_count(), 1) << "what was queued must be freed";
  EXPECT_EQ(queue.push(value), PushResult::kClosed);
  EXPECT_TRUE(queue.tryReserve({}));
  EXPECT_EQ(queue.pushReserved(value), PushResult::kClosed);
}

TEST(Queue, ManyProducersLoseNothing) {
  constexpr int kProducers = 4;
  constexpr int kEach = 5000;
  Queue<int> queue(64, Overflow::kReject);
  std::vector<std::thread> producers;
  for (int p = 0; p < kProducers; ++p) {
    producers.emplace_back([&, p] {
      for (int i = 0; i < kEach;) {
        if (queue.push(p * kEach + i) == PushResult::kAccepted) {
          ++i;
        } else {
          std::this_thread::yield();
        }
      }
    });
  }
  std::vector<int> last(kProducers, -1);
  for (int received = 0; received < kProducers * kEach;) {
    const auto value = queue.pop();
    if (!value) {
      std::this_thread::yield();
      continue;
    }
    ASSERT_LE(queue.size(), queue.capacity());
    const int producer = *value / kEach;
    EXPECT_GT(*value, last[static_cast<std::size_t>(producer)]) << "order of one producer is kept";
    last[static_cast<std::size_t>(producer)] = *value;
    ++received;
  }
  for (std::thread& producer : producers) producer.join();
  EXPECT_EQ(queue.size(), 0u);
}

}  // namespace
}  // namespace grove::pipeline
