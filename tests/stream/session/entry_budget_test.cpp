#include "stream/session/entry_budget.h"

#include <gtest/gtest.h>

#include <map>

namespace grove::stream {
namespace {

constexpr double kLook = 0.004;

// Fault: first frames that take as much time as they like, so that those inside get half their frames.
TEST(EntryBudget, GivesFirstFramesAShareOfTheTime) {
  EntryBudget budget;
  constexpr double kFrame = 0.080;
  double busy = 0.0;
  node::SessionId session = 1;
  double began = -1.0;
  for (int i = 0; i < 10'000; ++i) {
    const double now = 100.0 + i * kLook;
    if (began < 0.0 && budget.mayBegin(session, now)) began = now;
    if (began >= 0.0 && now - began >= kFrame) {
      busy += now - began;
      budget.end(session++, now);
      began = -1.0;
    }
  }
  EXPECT_LT(busy / (10'000 * kLook), 0.2);
  EXPECT_GT(session, 60U) << "newcomers do get in";
}

// Faults: a newcomer who is overtaken by those after him; one who has left, is hidden or never finishes, and keeps all
// others waiting.
TEST(EntryBudget, IsFirstComeFirstServedAmongThoseWhoAsk) {
  EntryBudget budget;
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
TEST(EntryBudget, LetsNobodyWaitLongForTheOneBefore) {
  EntryBudget budget;
  EXPECT_TRUE(budget.mayBegin(1, 10.0));
  budget.end(1, 11.5);
  EXPECT_FALSE(budget.mayBegin(2, 12.4));
  EXPECT_TRUE(budget.mayBegin(2, 12.6));
}

}  // namespace
}  // namespace grove::stream
