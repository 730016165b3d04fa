#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <memory>

#include "node/frontend/shared/shared_store_fixture.h"

namespace grove::node {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// What announcements and versions do to a shared store.
class SharedChanges : public SharedStoreTest {};

TEST_F(SharedChanges, AnnouncedChangesAreFetchedOnUse) {
  for (const SharedKey& what : {own, a}) {
    fetched.clear();
    bring(what, 1);
    store.announced({what, 2});
    EXPECT_THAT(fetched, IsEmpty()) << "nobody has used what is there";
    EXPECT_EQ(versionOf(what), 1U) << "which stands in until the change comes";
    EXPECT_THAT(fetched, ElementsAre(what));
    EXPECT_EQ(versionOf(what), 1U);
    store.announced({what, 2});
    EXPECT_THAT(fetched, ElementsAre(what)) << "it is under way";
    bring(what, 2);
    EXPECT_EQ(versionOf(what), 2U);
    EXPECT_EQ(fetched.size(), 1U);
    store.announced({what, 3});
    EXPECT_EQ(fetched.size(), 2U) << "at once, for it was used";
  }
}

TEST_F(SharedChanges, ChangesDuringAFetchAreFetchedToo) {
  for (const SharedKey& what : {own, a}) {
    fetched.clear();
    bring(what, 1);
    (void)store.find(what);
    store.announced({what, 2});
    store.announced({what, 3});
    bring(what, 2);
    EXPECT_EQ(fetched.size(), 1U);
    EXPECT_EQ(versionOf(what), 2U);
    EXPECT_EQ(fetched.size(), 2U);
  }
}

TEST_F(SharedChanges, AnnouncementMayOvertakeAnAnswer) {
  for (const SharedKey& what : {own, a}) {
    fetched.clear();
    get(what);
    store.announced({what, 2});
    bring(what, 1);
    EXPECT_EQ(versionOf(what), 1U);
    EXPECT_THAT(fetched, ElementsAre(what, what));
  }
}

TEST_F(SharedChanges, UnwantedAnnouncementsAreForgotten) {
  store.announced({a, 7});
  EXPECT_THAT(fetched, IsEmpty());
  EXPECT_EQ(store.statistics().entries, 0U);
}

/// Would catch a peer who fills the store with what nobody wants, or changes what is there.
TEST_F(SharedChanges, RefusesUnrequestedData) {
  for (const SharedKey& what : {a, own}) {
    EXPECT_FALSE(awaits(what));
    EXPECT_FALSE(store.put(resultOf(what, 1)));
    EXPECT_FALSE(store.put(failureOf(what)));
    EXPECT_FALSE(store.find(what));
    get(what);
    EXPECT_TRUE(awaits(what));
    bring(what, 5);
    EXPECT_FALSE(store.put(resultOf(what, 6))) << "once";
    EXPECT_EQ(versionOf(what), 5U);
  }
}

/// Or a node that has restarted would answer with differences to data that it does not have.
TEST_F(SharedChanges, AfterARestartAllIsFetchedWhole) {
  const SharedKey elsewhere{kObject + 1, {}};
  for (const SharedKey& what : {own, a, elsewhere}) bring(what, 900);
  const auto isOfNode = [](world::ObjectId id) { return id == kObject; };
  store.renew(isOfNode, true);
  EXPECT_THAT(fetched, IsEmpty()) << "nobody has used it since";
  for (const SharedKey& what : {own, a, elsewhere}) EXPECT_EQ(versionOf(what), 900U) << "shown as it was meanwhile";
  EXPECT_THAT(fetched, ElementsAre(own, a));
  EXPECT_THAT(known, ElementsAre(0U, 0U));
  EXPECT_EQ(store.known(own), nullptr) << "no base of a difference";
  EXPECT_NE(store.known(elsewhere), nullptr);
  bring(own, 3);
  bring(a, 900);
  EXPECT_EQ(versionOf(own), 3U);
  store.announced({own, 4});
  store.announced({a, 901});
  (void)store.find(a);
  EXPECT_THAT(known, ElementsAre(0U, 0U, 3U, 900U)) << "from then on its versions count";
}

TEST_F(SharedChanges, RestartForgetsAnnouncements) {
  get(a);
  store.announced({a, 900});
  store.renew([](world::ObjectId) { return true; }, true);
  get(a);
  EXPECT_THAT(fetched, ElementsAre(a, a)) << "the first request may be lost";
  bring(a, 1);
  EXPECT_EQ(versionOf(a), 1U);
  EXPECT_EQ(fetched.size(), 2U) << "it is not older than anything";
}

TEST_F(SharedChanges, AfterALostLinkDataIsFetchedAsDifferences) {
  bring(own, 7);
  store.renew([](world::ObjectId) { return true; }, false);
  EXPECT_EQ(versionOf(own), 7U);
  EXPECT_THAT(fetched, ElementsAre(own)) << "an announcement may have been lost";
  EXPECT_THAT(known, ElementsAre(7U));
}

/// Would catch a version that is higher than any to come, which nothing ever replaced.
TEST_F(SharedChanges, NoVersionStaysForever) {
  constexpr Version kHighest = std::numeric_limits<Version>::max();
  for (const SharedKey& what : {own, a}) {
    bring(what, kHighest);
    EXPECT_EQ(versionOf(what), kHighest);
    store.announced({what, 6});
    bring(what, 6);
    EXPECT_EQ(versionOf(what), 6U);
  }
}

TEST_F(SharedChanges, ExtremeAnnouncementCostsTwoRequests) {
  constexpr Version kHighest = std::numeric_limits<Version>::max();
  for (const SharedKey& what : {own, a}) {
    bring(what, 5);
    (void)store.find(what);
    fetched.clear();
    store.announced({what, kHighest});
    for (int i = 0; i < 5; ++i) {
      if (awaits(what)) bring(what, 5);
      (void)store.find(what);
    }
    EXPECT_EQ(fetched.size(), 2U);
    store.announced({what, 6});
    EXPECT_EQ(fetched.size(), 3U);
    bring(what, 6);
    EXPECT_EQ(versionOf(what), 6U);
  }
}

}  // namespace
}  // namespace grove::node
