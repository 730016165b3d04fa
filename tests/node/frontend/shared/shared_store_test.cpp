#include "node/frontend/shared/shared_store.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "node/frontend/shared/shared_store_fixture.h"
#include "pipeline/worker_pool.h"

namespace grove::node {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST_F(SharedStoreTest, RequestsOnceForManyWaiters) {
  for (int i = 0; i < 3; ++i) get(a);
  get(own);
  EXPECT_THAT(fetched, ElementsAre(a, own));
  EXPECT_THAT(got, IsEmpty());
  bring(a, 1);
  EXPECT_THAT(got, ElementsAre("version 1", "version 1", "version 1"));
  get(a);
  EXPECT_EQ(got.size(), 4U) << "at once";
  EXPECT_EQ(fetched.size(), 2U);
  bring(own, 1);
  EXPECT_EQ(got.size(), 5U);
}

TEST_F(SharedStoreTest, EqualKeysOfDifferentObjectsDiffer) {
  const SharedKey other{kObject + 1, "a"};
  get(a);
  get(other);
  EXPECT_THAT(fetched, ElementsAre(a, other));
  bring(other, 3);
  EXPECT_EQ(versionOf(other), 3U);
  EXPECT_EQ(versionOf(a), 0U);
}

TEST_F(SharedStoreTest, EvictsLeastRecentlyUsedViews) {
  bring(own, 1);
  bring(a, 1);
  bring(b, 1);
  EXPECT_EQ(store.statistics().bytes, 1200U) << "an object's own data does not count";
  (void)store.find(a);
  bring(c, 1);
  EXPECT_EQ(versionOf(b), 0U);
  EXPECT_EQ(versionOf(a), 1U);
  EXPECT_EQ(versionOf(c), 1U);
  EXPECT_EQ(versionOf(own), 1U);
  EXPECT_EQ(store.statistics().entries, 3U);
  EXPECT_EQ(store.statistics().bytes, 1200U);
}

TEST_F(SharedStoreTest, EvictedDataLivesWhileInUse) {
  bring(a, 1);
  const std::shared_ptr<const SharedData> drawn = store.find(a);
  const std::weak_ptr<const SharedData> left = [&] {
    bring(b, 1);
    return store.find(b);
  }();
  (void)store.find(a);
  bring(c, 1);
  EXPECT_TRUE(left.expired()) << "nobody draws it";
  bring({kObject, "d"}, 1);
  EXPECT_EQ(versionOf(a), 0U);
  EXPECT_EQ(drawn->version(), 1U);
  EXPECT_EQ(drawn.use_count(), 1);
  get(a);
  EXPECT_THAT(fetched, ElementsAre(a)) << "it is requested anew";
}

TEST_F(SharedStoreTest, OversizedDataReachesItsWaiters) {
  get(a);
  EXPECT_TRUE(store.put(resultOf(a, 1, 2 * kMaxBytes)));
  EXPECT_THAT(got, ElementsAre("version 1"));
  EXPECT_EQ(versionOf(a), 0U);
  EXPECT_EQ(store.statistics().bytes, 0U);
}

TEST_F(SharedStoreTest, FailureIsReportedAndRetried) {
  get(a);
  get(a);
  EXPECT_TRUE(store.put(failureOf(a)));
  EXPECT_THAT(got, ElementsAre("broken", "broken"));
  get(a);
  EXPECT_EQ(fetched.size(), 2U);
  bring(a, 1);
  EXPECT_EQ(got.back(), "version 1");
}

TEST_F(SharedStoreTest, FailedChangeKeepsOldDataAndIsRetried) {
  bring(a, 1);
  (void)store.find(a);
  store.announced({a, 2});
  EXPECT_TRUE(store.put(failureOf(a)));
  EXPECT_EQ(versionOf(a), 1U);
  EXPECT_EQ(fetched.size(), 2U);
}

TEST_F(SharedStoreTest, RefusedRequestFailsForAllWaiters) {
  full = true;
  get(a);
  EXPECT_THAT(got, ElementsAre("the backend node is full"));
  full = false;
  broken = true;
  get(a);
  EXPECT_EQ(got.back(), "the wire is broken");
  broken = false;
  get(a);
  EXPECT_THAT(fetched, ElementsAre(a));
}

TEST_F(SharedStoreTest, LateDataIsRequestedAgain) {
  get(a, -1.0);
  get(a);
  get(a);
  EXPECT_EQ(fetched.size(), 2U);
  bring(a, 1);
  EXPECT_THAT(got, ElementsAre("the backend node did not respond in time", "version 1", "version 1"));
}

/// Would catch waiters that pile up, thirty a second for each visitor.
TEST_F(SharedStoreTest, WaitersOfASilentBackendAreReleased) {
  for (int frame = 0; frame < 100; ++frame) get(a, -1.0);
  EXPECT_GE(got.size(), 99U);
}

/// A backend that answers on threads of its own, a store with room for a few, and many who use it: what they get is
/// what they asked for, and everybody gets it once.
TEST(SharedStoreThreads, EveryWaiterIsAnsweredOnce) {
  constexpr int kThreads = 4;
  constexpr int kRounds = 500;
  constexpr int kKeys = 6;
  pipeline::WorkerPool backend(2);
  std::atomic<Version> version{1};
  std::atomic<SharedStore*> front{nullptr};
  SharedStore store(3 * 400, [&](const ToBackend& message) {
    const auto& request = std::get<Request>(message);
    backend.post(
        [&, what = SharedKey{request.object, request.key}] { (void)front.load()->put(resultOf(what, version)); });
    return true;
  });
  front = &store;
  std::atomic<int> gotten{0};
  {
    std::vector<std::jthread> threads;
    threads.reserve(kThreads);
    for (int thread = 0; thread < kThreads; ++thread) {
      threads.emplace_back([&, thread] {
        for (int i = 0; i < kRounds; ++i) {
          const int key = (i * 7 + thread * 3) % kKeys;
          const SharedKey what{kObject, key == 0 ? Key() : std::to_string(key)};
          store.get(requestFor(what), [&](const Payload& payload) {
            if (std::holds_alternative<std::shared_ptr<const SharedData>>(payload)) ++gotten;
          });
          if (i % 50 == 0) store.announced({what, ++version});
          static_cast<void>(store.find(what));
          static_cast<void>(store.statistics());
        }
      });
    }
  }
  for (int i = 0; i < 3; ++i) backend.drain();
  EXPECT_EQ(gotten, kThreads * kRounds);
  EXPECT_LE(store.statistics().entries, 4U);
}

}  // namespace
}  // namespace grove::node
