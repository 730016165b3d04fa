#include "stream/session/entry_budget.h"

#include <gtest/gtest.h>

#include <map>
#include <optional>
#include <set>
#include <utility>

namespace grove::stream {
namespace {

constexpr double kLook = 0.004;

// Fault: first frames that take as much time as they like, so that those inside get half their frames.
TEST(EntryBudget, GivesFirstFramesAShareOfTheTime) {
  EntryBudget budget(1);
  constexpr double kFrame = 0.080;
  double busy = 0.0;
  node::SessionId session = 1;
  double began = -1.0;
  for (int i = 0; i < 10'000; ++i) {
    const double now = 100.0 + i * kLook;
    if (began < 0.0 && budget.mayBegin(session, now)) began = now;
    if (began >= 0.0 && now - began >= kFrame) {
      busy += now - began;
      budget.enter(session++, now);
      began = -1.0;
    }
  }
  EXPECT_LT(busy / (10'000 * kLook), 0.2);
  EXPECT_GT(session, 60U) << "newcomers do get in";
}

// Faults: a newcomer who is overtaken by those after him; one who has left, is hidden or never finishes, and keeps all
// others waiting.
TEST(EntryBudget, IsFirstComeFirstServedAmongThoseWhoAsk) {
  EntryBudget budget(1);
  EXPECT_TRUE(budget.mayBegin(1, 10.0));
  for (const node::SessionId session : {2U, 3U, 4U, 5U}) EXPECT_FALSE(budget.mayBegin(session, 10.0));
  budget.leave(2, 10.01);
  budget.enter(1, 10.02);
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
TEST(EntryBudget, LetsNobodyWaitLongForTheOneBefore) {
  EntryBudget budget(1);
  EXPECT_TRUE(budget.mayBegin(1, 10.0));
  budget.enter(1, 11.5);
  EXPECT_FALSE(budget.mayBegin(2, 12.4));
  EXPECT_TRUE(budget.mayBegin(2, 12.6));
}

/// Seconds until the last of `newcomers` who come at once has entered, where each first frame takes 0.05 s.
double secondsUntilAllAreInside(int cores, node::SessionId inside, node::SessionId newcomers) {
  EntryBudget budget(cores);
  for (node::SessionId session = 1; session <= inside; ++session) budget.enter(session, 0.0);
  std::set<node::SessionId> outside;
  for (node::SessionId i = 1; i <= newcomers; ++i) outside.insert(inside + i);
  std::optional<node::SessionId> entering;
  double began = 0.0;
  double now = 0.0;
  for (; !outside.empty(); now += kLook) {
    if (entering && now - began >= 0.05) {
      budget.enter(*entering, now);
      outside.erase(*std::exchange(entering, std::nullopt));
    }
    for (const node::SessionId session : outside) {
      if (session == entering || !budget.mayBegin(session, now)) continue;
      entering = session;
      began = now;
    }
  }
  return now;
}

// Fault: newcomers who come together wait for the sake of visitors who are not there.
TEST(EntryBudget, LetsManyInQuicklyWhereFewAreInside) {
  EXPECT_LT(secondsUntilAllAreInside(2, 0, 6), 0.65);
  EXPECT_GT(secondsUntilAllAreInside(2, 30, 6), 0.75);
  EXPECT_LT(secondsUntilAllAreInside(16, 30, 6), 0.4) << "a sixth of 16 cores";
}

// Fault: visitors who have left count for ever.
TEST(EntryBudget, ForgetsWhoHasLeft) {
  EntryBudget budget(1);
  for (node::SessionId session = 1; session < 100; ++session) budget.enter(session, 10.0);
  for (node::SessionId session = 1; session < 100; ++session) budget.leave(session, 10.0);
  EXPECT_TRUE(budget.mayBegin(200, 10.0));
  EXPECT_FALSE(budget.mayBegin(201, 10.01));
  budget.leave(200, 10.1);
  EXPECT_TRUE(budget.mayBegin(201, 10.104)) << "nobody is inside";
}

}  // namespace
}  // namespace grove::stream
