#include "pipeline/turns.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

#include "pipeline/queue.h"

namespace grove::pipeline {
namespace {

using ::testing::ElementsAre;

struct Guest {
  std::uint64_t line = 0;
  int number = 0;
};
std::uint64_t lineOf(const Guest& guest) { return guest.line; }

std::vector<int> numbersFrom(Queue<Guest>& queue) {
  std::vector<int> numbers;
  while (const auto guest = queue.pop()) numbers.push_back(guest->number);
  return numbers;
}

/// Fails if who asks for much is answered before all others.
TEST(Turns, ServeEachLineInOrder) {
  Queue<Guest> queue(100, Overflow::kReject);
  for (int i = 0; i < 4; ++i) queue.push({7, 70 + i});
  for (int i = 0; i < 2; ++i) queue.push({9, 90 + i});
  queue.push({0, 1});
  EXPECT_THAT(numbersFrom(queue), ElementsAre(70, 90, 1, 71, 91, 72, 73));
}

TEST(Turns, ResumeWhenALineReturns) {
  Queue<Guest> queue(100, Overflow::kReject);
  for (int i = 0; i < 3; ++i) queue.push({7, 70 + i});
  EXPECT_EQ(queue.pop()->number, 70);
  queue.push({3, 30});
  EXPECT_EQ(queue.pop()->number, 30);
  queue.push({3, 31});
  EXPECT_EQ(queue.pop()->number, 71) << "3 has just been served";
  EXPECT_THAT(numbersFrom(queue), ElementsAre(31, 72));
}

/// Fails if one line can keep the others out.
TEST(Turns, OneLineTakesHalfOfAQueueAtMost) {
  Queue<Guest> queue(8, Overflow::kReject);
  for (int i = 0; i < 4; ++i) EXPECT_EQ(queue.push({1, i}), PushResult::kAccepted);
  EXPECT_EQ(queue.push({1, 4}), PushResult::kRejected);
  EXPECT_EQ(queue.push({2, 0}), PushResult::kAccepted);
  (void)queue.pop();
  EXPECT_EQ(queue.push({1, 4}), PushResult::kAccepted);
  EXPECT_EQ(queue.size(), 5U);
  queue.close();
  EXPECT_EQ(queue.size(), 0U);
}

}  // namespace
}  // namespace grove::pipeline
