#include "node/messages/use_record.h"

#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <thread>
#include <vector>

namespace grove::node {
namespace {

using Use = UseRecord::Use;

constexpr SessionId kAda = makeId(1, 1);
constexpr SessionId kBob = makeId(1, 2);
constexpr SessionId kCem = makeId(2, 1);

/// Would catch a visitor's own reuse that counts as sharing.
TEST(UseRecord, KnowsTheFirstUserFromAllOthers) {
  UseRecord uses;
  uses.begin();
  EXPECT_EQ(uses.by(kAda), Use::kFirst);
  EXPECT_EQ(uses.by(kAda), Use::kAgain);
  EXPECT_EQ(uses.by(kBob), Use::kFirstByOther);
  EXPECT_EQ(uses.by(kBob), Use::kByOther);
  EXPECT_EQ(uses.by(kCem), Use::kByOther);
  uses.begin();
  EXPECT_EQ(uses.by(kAda), Use::kAgain) << "a second beginning forgets nothing";
}

/// Would catch a visitor's own picture of a near tree that counts as made for all.
TEST(UseRecord, CountsNothingBeforeItsBeginning) {
  UseRecord uses;
  EXPECT_EQ(uses.by(kAda), Use::kUncounted);
  uses.begin();
  EXPECT_EQ(uses.by(kBob), Use::kFirst);
}

/// Would catch two first users, or data that becomes shared twice.
TEST(UseRecord, HasOneFirstUserOfManyAtOnce) {
  constexpr int kUsers = 4;
  for (int round = 0; round < 200; ++round) {
    UseRecord uses;
    uses.begin();
    std::array<std::atomic<int>, 5> counted{};
    std::vector<std::thread> users;
    for (std::uint32_t user = 1; user <= kUsers; ++user) {
      users.emplace_back([&, user] { ++counted[static_cast<std::size_t>(uses.by(makeId(1, user)))]; });
    }
    for (std::thread& user : users) user.join();
    EXPECT_EQ(counted[static_cast<std::size_t>(Use::kFirst)], 1);
    EXPECT_EQ(counted[static_cast<std::size_t>(Use::kFirstByOther)], 1);
    EXPECT_EQ(counted[static_cast<std::size_t>(Use::kByOther)], kUsers - 2);
  }
}

}  // namespace
}  // namespace grove::node
