#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>

#include "node/frontend/shared/shared_store_fixture.h"
#include "node/limits.h"

namespace grove::node {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// What a shared store does with data that a clock changes.
class SubscribedData : public SharedStoreTest {
 protected:
  static Result clockedOf(const SharedKey& what, Version version) {
    Result result = resultOf(what, version);
    result.payload = std::make_shared<const Block>(version, 400, 30.0);
    return result;
  }
  static Result pushed(const SharedKey& what, Version version) {
    Result result = clockedOf(what, version);
    result.pushed = true;
    return result;
  }
  /// Version 1 is there by request, version 2 by subscription.
  void subscribe(const SharedKey& what) {
    get(what);
    EXPECT_TRUE(store.put(clockedOf(what, 1)));
    (void)store.find(what);
    store.announced({what, 2});
    EXPECT_TRUE(store.put(clockedOf(what, 2)));
    ASSERT_THAT(subscribes, ElementsAre(true));
    fetched.clear();
    known.clear();
    subscribes.clear();
  }
  std::size_t acknowledged() const {
    std::size_t count = 0;
    for (const ToBackend& message : told) count += std::holds_alternative<Acknowledgement>(message) ? 1 : 0;
    return count;
  }
  std::size_t unsubscribed() const { return told.size() - acknowledged(); }
};

TEST_F(SubscribedData, ArrivesWithoutRequests) {
  for (const SharedKey& what : {own, a}) {
    told.clear();
    ASSERT_NO_FATAL_FAILURE(subscribe(what));
    for (Version version = 3; version < 3 + 10 * kAcknowledgedAtOnce; ++version) {
      EXPECT_TRUE(store.awaits(pushed(what, version)));
      EXPECT_TRUE(store.put(pushed(what, version)));
      EXPECT_EQ(versionOf(what), version);
    }
    EXPECT_THAT(fetched, IsEmpty());
    EXPECT_EQ(acknowledged(), 10U);
    const auto& last = std::get<Acknowledgement>(told.back());
    EXPECT_EQ(last.what, what);
    EXPECT_EQ(last.version, 2 + 10 * kAcknowledgedAtOnce);
    EXPECT_EQ(unsubscribed(), 0U);
  }
}

TEST_F(SubscribedData, IsOnlyClockedData) {
  bring(own, 1);
  (void)store.find(own);
  store.announced({own, 2});
  EXPECT_THAT(subscribes, ElementsAre(false));
}

/// Would catch a node that sends on what no visitor sees, and visitors who never see it again.
TEST_F(SubscribedData, UnusedDataIsUnsubscribed) {
  ASSERT_NO_FATAL_FAILURE(subscribe(own));
  (void)store.find(own);
  Version version = 3;
  for (; unsubscribed() == 0 && version < 1000; ++version) EXPECT_TRUE(store.put(pushed(own, version)));
  EXPECT_EQ(version, 4 + SharedStore::kMaxUnused) << "version 2 was used";
  EXPECT_EQ(std::get<Unsubscribe>(told.back()).what, own);
  EXPECT_FALSE(store.put(pushed(own, version))) << "one that was under way";
  EXPECT_EQ(versionOf(own), version - 1);
  EXPECT_THAT(known, ElementsAre(version - 1)) << "it is used again";
  EXPECT_THAT(subscribes, ElementsAre(true));
}

/// Would catch a node whose later versions all change one that was lost.
TEST_F(SubscribedData, ResubscribesAfterBadData) {
  ASSERT_NO_FATAL_FAILURE(subscribe(own));
  Result failed = failureOf(own);
  failed.pushed = true;
  EXPECT_TRUE(store.put(failed));
  EXPECT_EQ(versionOf(own), 2U) << "shown meanwhile";
  EXPECT_THAT(known, ElementsAre(2U));
  EXPECT_THAT(subscribes, ElementsAre(true));
  EXPECT_FALSE(store.put(pushed(own, 5))) << "sent before the node knew";
  EXPECT_EQ(unsubscribed(), 0U) << "which must not end the new subscription";
  EXPECT_TRUE(store.put(clockedOf(own, 6)));
  EXPECT_TRUE(store.put(pushed(own, 7)));
  EXPECT_EQ(versionOf(own), 7U);
}

TEST_F(SubscribedData, ResubscribesAfterARestart) {
  ASSERT_NO_FATAL_FAILURE(subscribe(own));
  store.renew([](world::ObjectId) { return true; }, true);
  EXPECT_EQ(versionOf(own), 2U);
  EXPECT_THAT(known, ElementsAre(0U)) << "of its former life the node knows nothing";
  EXPECT_THAT(subscribes, ElementsAre(true));
}

/// Would catch a node that fills the store with what nobody wants.
TEST_F(SubscribedData, IsRefusedWithoutSubscription) {
  EXPECT_FALSE(store.awaits(pushed(a, 1)));
  EXPECT_FALSE(store.put(pushed(a, 1)));
  EXPECT_FALSE(store.find(a));
  EXPECT_EQ(unsubscribed(), 1U);
  bring(own, 1);
  EXPECT_FALSE(store.put(pushed(own, 2)));
  EXPECT_EQ(versionOf(own), 1U);
}

}  // namespace
}  // namespace grove::node
