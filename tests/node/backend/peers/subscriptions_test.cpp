#include "node/backend/peers/subscriptions.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <vector>

#include "node/limits.h"

namespace grove::node {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// The subscriptions of a peer, and what the node is asked for.
class SubscriptionsTest : public ::testing::Test {
 protected:
  SubscriptionsTest() {
    subscriptions.connect([this](const SharedKey&, Version known) {
      if (!full) asked.push_back(known);
      return !full;
    });
  }
  /// A version is published, and sent if the node is asked for it.
  void push(Version version) {
    asked.clear();
    ASSERT_TRUE(subscriptions.published(fire, version));
    if (!asked.empty()) subscriptions.sent(fire, version, true);
  }

  const SharedKey fire{7, {}};
  bool full = false;
  std::vector<Version> asked;  ///< what the peer knows
  Subscriptions subscriptions;
};

TEST_F(SubscriptionsTest, EachVersionGoesToUpToDatePeers) {
  EXPECT_FALSE(subscriptions.published(fire, 1)) << "it is to be announced";
  ASSERT_TRUE(subscriptions.begin(fire));
  subscriptions.sent(fire, 2, false);
  EXPECT_THAT(asked, IsEmpty()) << "there is nothing newer";
  EXPECT_TRUE(subscriptions.published(fire, 3));
  subscriptions.sent(fire, 3, true);
  EXPECT_TRUE(subscriptions.published(fire, 4));
  EXPECT_THAT(asked, ElementsAre(2U, 3U));
  EXPECT_FALSE(subscriptions.published({7, "other"}, 4));
  subscriptions.end(fire);
  EXPECT_FALSE(subscriptions.published(fire, 5));
}

/// Would catch versions that are made one upon the other, or one that is forgotten because it came in between.
TEST_F(SubscriptionsTest, PublishedDuringPackingIsSentNext) {
  ASSERT_TRUE(subscriptions.begin(fire));
  EXPECT_TRUE(subscriptions.published(fire, 2)) << "the first answer is being made";
  EXPECT_THAT(asked, IsEmpty());
  subscriptions.sent(fire, 1, false);
  EXPECT_THAT(asked, ElementsAre(1U));
  EXPECT_TRUE(subscriptions.published(fire, 3));
  EXPECT_TRUE(subscriptions.published(fire, 4));
  EXPECT_THAT(asked, ElementsAre(1U));
  subscriptions.sent(fire, 2, true);
  EXPECT_THAT(asked, ElementsAre(1U, 2U));
  subscriptions.sent(fire, 4, true);
  EXPECT_THAT(asked, ElementsAre(1U, 2U));
}

/// Would catch versions that queue on a slow link.
TEST_F(SubscriptionsTest, PeerWithoutAcknowledgementsGetsNoMore) {
  ASSERT_TRUE(subscriptions.begin(fire));
  subscriptions.sent(fire, 1, false);
  for (Version version = 2; version < 2 + kMaxUnacknowledged; ++version) {
    push(version);
    EXPECT_EQ(asked.size(), 1U);
  }
  for (Version version = 100; version < 200; ++version) push(version);
  EXPECT_THAT(asked, IsEmpty());
  subscriptions.acknowledged(fire, 2);
  EXPECT_THAT(asked, ElementsAre(1U + kMaxUnacknowledged)) << "the newest, as a change to the last one that went";
}

TEST_F(SubscriptionsTest, EarlyAcknowledgementsCount) {
  ASSERT_TRUE(subscriptions.begin(fire));
  subscriptions.sent(fire, 1, false);
  for (Version version = 2; version < 100; ++version) {
    asked.clear();
    ASSERT_TRUE(subscriptions.published(fire, version));
    ASSERT_EQ(asked.size(), 1U) << version;
    subscriptions.acknowledged(fire, version);
    subscriptions.sent(fire, version, true);
  }
}

/// Would catch a change to a version that the peer does not have.
TEST_F(SubscriptionsTest, SecondRequestStartsOver) {
  ASSERT_TRUE(subscriptions.begin(fire));
  subscriptions.sent(fire, 8, false);
  push(9);
  asked.clear();
  ASSERT_TRUE(subscriptions.begin(fire));
  EXPECT_TRUE(subscriptions.published(fire, 11));
  subscriptions.sent(fire, 10, true);
  EXPECT_THAT(asked, IsEmpty()) << "that was still of the first one";
  subscriptions.sent(fire, 10, false);
  EXPECT_THAT(asked, ElementsAre(10U));
}

TEST_F(SubscriptionsTest, FullNodeIsRetried) {
  ASSERT_TRUE(subscriptions.begin(fire));
  subscriptions.sent(fire, 1, false);
  full = true;
  EXPECT_TRUE(subscriptions.published(fire, 2));
  full = false;
  EXPECT_TRUE(subscriptions.published(fire, 3));
  EXPECT_THAT(asked, ElementsAre(1U));
}

TEST_F(SubscriptionsTest, VersionsWrapAround) {
  constexpr Version kHighest = std::numeric_limits<Version>::max();
  ASSERT_TRUE(subscriptions.begin(fire));
  subscriptions.sent(fire, kHighest, false);
  EXPECT_TRUE(subscriptions.published(fire, 0));
  EXPECT_THAT(asked, ElementsAre(kHighest));
}

/// Would catch a peer that takes the node's memory.
TEST_F(SubscriptionsTest, ArePerPeerLimited) {
  for (std::size_t i = 0; i < Subscriptions::kMax; ++i) EXPECT_TRUE(subscriptions.begin({7, std::to_string(i)}));
  EXPECT_FALSE(subscriptions.begin(fire));
  EXPECT_FALSE(subscriptions.published(fire, 1)) << "its changes are announced";
  EXPECT_TRUE(subscriptions.begin({7, "0"})) << "it has that one";
  subscriptions.end({7, "1"});
  EXPECT_TRUE(subscriptions.begin(fire));
}

}  // namespace
}  // namespace grove::node
