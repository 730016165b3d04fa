#include "stream/session/entry_budget.h"

#include <gtest/gtest.h>

#include <map>

namespace grove::stream {
namespace {

constexpr double kLook = 0.004;

// Fault: first frames that take as much time as they like, so that those inside get half their frames.
TEST(EntryBudget, FirstFramesGetAShareOfTime) {
  EntryBudget budget(2);
  constexpr double kFrame = 0.080;
  double busy = 0.0;
  node::SessionId session = 1;
  double began = -1.0;
  for (int i = 0; i < 20'000; ++i) {
    const double now = 100.0 + i * kLook;
    if (began < 0.0 && budget.mayBegin(session, now)) began = now;
    if (began >= 0.0 && now - began >= kFrame) {
      busy += now - began;
      budget.end(session++, now);
      began = -1.0;
    }
  }
  EXPECT_LT(busy / (20'000 * kLook), 0.2);
  EXPECT_GT(session, 60U) << "newcomers do get in";
}

// Faults: a newcomer who is overtaken by those after him; one who has left, is hidden or never finishes, and keeps all
// others waiting.
TEST(EntryBudget, IsFirstComeFirstServed) {
  EntryBudget budget(2);
  EXPECT_TRUE(budget.mayBegin(1, 10.0));
  for (const node::SessionId session : {2U, 3U, 4U, 5U}) EXPECT_FALSE(budget.mayBegin(session, 10.0));
  budget.end(2, 10.01);
  budget.end(1, 10.02);
  // Sessions 2 and 3 ask no more. The first of the others is 4.
  std::map<node::SessionId, double> entered;
  for (int i = 0; i < 2000 && entered.size() < 2; ++i) {
    const double now = 10.1 + i * kLook;
    for (const node::SessionId session : {5U, 4U}) {
      if (entered.contains(session) || !budget.mayBegin(session, now)) continue;
      entered[session] = now;
    }
  }
  ASSERT_EQ(entered.size(), 2U) << "4 never finished";
  EXPECT_LT(entered[4], entered[5]);
}

// Fault: a slow machine on which the next newcomer waits for ever.
TEST(EntryBudget, BoundsTheWaitForThePredecessor) {
  EntryBudget budget(2);
  EXPECT_TRUE(budget.mayBegin(1, 10.0));
  budget.end(1, 11.9);
  EXPECT_FALSE(budget.mayBegin(2, 12.8));
  EXPECT_TRUE(budget.mayBegin(2, 13.0));
}

// Faults: newcomers who come together to a quiet world wait for seconds; a crowd without end enters at once.
TEST(EntryBudget, AdmitsTheFirstImmediately) {
  EntryBudget budget(2);
  double now = 10.0;
  node::SessionId session = 1;
  while (session < 100 && budget.mayBegin(session, now)) budget.end(session++, now += 0.08);
  EXPECT_GT(session, 16U) << "a full world";
  EXPECT_LT(session, 32U) << "the bucket is empty";
  EXPECT_TRUE(budget.mayBegin(session, now + 1.0));
}

// Fault: those who come, leave and come again take the machine from those who stay.
TEST(EntryBudget, ReconnectingCrowdsGetNoMore) {
  EntryBudget budget(2);
  constexpr double kFrame = 0.050;
  double busy = 0.0;
  double began = -1.0;
  node::SessionId first = 1;
  for (int i = 0; i < 20'000; ++i) {
    const double now = 100.0 + i * kLook;
    for (node::SessionId session = first; session < first + 8; ++session) {
      if (budget.mayBegin(session, now) && began < 0.0) began = now;
    }
    if (began >= 0.0 && now - began >= kFrame) {
      busy += now - began;
      budget.end(first++, now);
      began = -1.0;
    }
  }
  EXPECT_LT(busy / (20'000 * kLook), 0.2);
  EXPECT_GT(busy, 1.0);
}

}  // namespace
}  // namespace grove::stream
