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

#include "pipeline/clocks.h"
#include "pipeline/worker_pool.h"

namespace grove::node {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// Shared data of so many bytes.
class Block final : public SharedData {
 public:
  Block(Version version, std::size_t bytes) : SharedData(version), bytes_(bytes) {}

 private:
  [[nodiscard]] std::size_t ownBytes() const noexcept override { return bytes_; }
  [[nodiscard]] PackedBytes pack() const override { return {}; }
  const std::size_t bytes_;
};

constexpr std::size_t kMaxBytes = 1000;
constexpr world::ObjectId kObject = 5;

Request requestFor(const SharedKey& what, double secondsLeft = 60.0) {
  auto view = std::make_shared<View>();
  view->deadline = pipeline::wallSeconds() + secondsLeft;
  Request request;
  request.view = std::move(view);
  request.object = what.object;
  request.shared = true;
  request.key = what.key;
  return request;
}

Result resultOf(const SharedKey& what, Version version, std::size_t bytes = 400) {
  Result result;
  result.what = what;
  result.shared = true;
  result.version = version;
  result.payload = std::make_shared<const Block>(version, bytes);
  return result;
}

Result failureOf(const SharedKey& what) {
  Result result;
  result.what = what;
  result.shared = true;
  result.payload = Failure{"broken"};
  return result;
}

std::string described(const Payload& payload) {
  if (const auto* failure = std::get_if<Failure>(&payload)) return failure->reason;
  const auto& data = std::get<std::shared_ptr<const SharedData>>(payload);
  return data ? "version " + std::to_string(data->version()) : "null";
}

class SharedStoreTest : public ::testing::Test {
 protected:
  void get(const SharedKey& what, double secondsLeft = 60.0) {
    store.get(requestFor(what, secondsLeft), [this](const Payload& payload) { got.push_back(described(payload)); });
  }
  /// As it would come from a backend node without a wait, asked for if it was not.
  void bring(const SharedKey& what, Version version) {
    if (store.put(resultOf(what, version))) return;
    const std::vector<SharedKey> before = fetched;
    store.get(requestFor(what), [](const Payload&) {});
    fetched = before;
    EXPECT_TRUE(store.put(resultOf(what, version)));
  }
  /// 0: it is not there.
  Version versionOf(const SharedKey& what) {
    const auto data = store.find(what);
    return data ? data->version() : 0;
  }

  bool full = false;
  bool broken = false;
  std::vector<SharedKey> fetched;
  std::vector<std::string> got;
  SharedStore store{kMaxBytes, [this](const Request& request) {
                      EXPECT_TRUE(request.shared);
                      if (broken) throw std::runtime_error("the wire is broken");
                      if (!full) fetched.push_back({request.object, request.key});
                      return !full;
                    }};
  const SharedKey own{kObject, {}};
  const SharedKey a{kObject, "a"};
  const SharedKey b{kObject, "b"};
  const SharedKey c{kObject, "c"};
};

TEST_F(SharedStoreTest, WhatManyWaitForIsRequestedOnce) {
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

TEST_F(SharedStoreTest, ObjectsWithLikeKeysAreToldApart) {
  const SharedKey other{kObject + 1, "a"};
  get(a);
  get(other);
  EXPECT_THAT(fetched, ElementsAre(a, other));
  bring(other, 3);
  EXPECT_EQ(versionOf(other), 3U);
  EXPECT_EQ(versionOf(a), 0U);
}

TEST_F(SharedStoreTest, GivesUpWhatWasUsedLongestAgoButNoObjectsOwnData) {
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

TEST_F(SharedStoreTest, WhatIsGivenUpLivesWhileItIsDrawn) {
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

TEST_F(SharedStoreTest, WhatIsLargerThanAllRoomStillReachesWhoWaits) {
  get(a);
  EXPECT_TRUE(store.put(resultOf(a, 1, 2 * kMaxBytes)));
  EXPECT_THAT(got, ElementsAre("version 1"));
  EXPECT_EQ(versionOf(a), 0U);
  EXPECT_EQ(store.statistics().bytes, 0U);
}

TEST_F(SharedStoreTest, AnAnnouncedChangeIsFetchedOnceItIsUsed) {
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

TEST_F(SharedStoreTest, AChangeBeyondWhatIsUnderWayIsFetchedToo) {
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

TEST_F(SharedStoreTest, AnAnnouncementMayOvertakeTheAnswerThatItMakesOld) {
  for (const SharedKey& what : {own, a}) {
    fetched.clear();
    get(what);
    store.announced({what, 2});
    bring(what, 1);
    EXPECT_EQ(versionOf(what), 1U);
    EXPECT_THAT(fetched, ElementsAre(what, what));
  }
}

TEST_F(SharedStoreTest, AnnouncementsOfWhatNobodyWantsAreForgotten) {
  store.announced({a, 7});
  EXPECT_THAT(fetched, IsEmpty());
  EXPECT_EQ(store.statistics().entries, 0U);
}

/// Would catch a peer who fills the store with what nobody wants, or changes what is there.
TEST_F(SharedStoreTest, WhatNobodyAskedForIsRefused) {
  for (const SharedKey& what : {a, own}) {
    EXPECT_FALSE(store.awaits(what));
    EXPECT_FALSE(store.put(resultOf(what, 1)));
    EXPECT_FALSE(store.put(failureOf(what)));
    EXPECT_FALSE(store.find(what));
    get(what);
    EXPECT_TRUE(store.awaits(what));
    bring(what, 5);
    EXPECT_FALSE(store.put(resultOf(what, 6))) << "once";
    EXPECT_EQ(versionOf(what), 5U);
  }
}

/// Would catch a version that is higher than any to come, which nothing ever replaced.
TEST_F(SharedStoreTest, NoVersionStaysForEver) {
  constexpr Version kHighest = std::numeric_limits<Version>::max();
  for (const SharedKey& what : {own, a}) {
    bring(what, kHighest);
    EXPECT_EQ(versionOf(what), kHighest);
    store.announced({what, 6});
    bring(what, 6);
    EXPECT_EQ(versionOf(what), 6U);
  }
}

TEST_F(SharedStoreTest, AnAbsurdAnnouncementCostsTwoRequestsAndHidesNoLaterOne) {
  constexpr Version kHighest = std::numeric_limits<Version>::max();
  for (const SharedKey& what : {own, a}) {
    bring(what, 5);
    (void)store.find(what);
    fetched.clear();
    store.announced({what, kHighest});
    for (int i = 0; i < 5; ++i) {
      if (store.awaits(what)) bring(what, 5);
      (void)store.find(what);
    }
    EXPECT_EQ(fetched.size(), 2U);
    store.announced({what, 6});
    EXPECT_EQ(fetched.size(), 3U);
    bring(what, 6);
    EXPECT_EQ(versionOf(what), 6U);
  }
}

TEST_F(SharedStoreTest, AFailureIsToldAndTriedAgain) {
  get(a);
  get(a);
  EXPECT_TRUE(store.put(failureOf(a)));
  EXPECT_THAT(got, ElementsAre("broken", "broken"));
  get(a);
  EXPECT_EQ(fetched.size(), 2U);
  bring(a, 1);
  EXPECT_EQ(got.back(), "version 1");
}

TEST_F(SharedStoreTest, AFailedChangeLeavesWhatIsThereAndIsTriedAgain) {
  bring(a, 1);
  (void)store.find(a);
  store.announced({a, 2});
  EXPECT_TRUE(store.put(failureOf(a)));
  EXPECT_EQ(versionOf(a), 1U);
  EXPECT_EQ(fetched.size(), 2U);
}

TEST_F(SharedStoreTest, ARefusedRequestFailsAtOnceForAllWhoWait) {
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

TEST_F(SharedStoreTest, WhatDoesNotComeInTimeIsRequestedAgain) {
  get(a, -1.0);
  get(a);
  get(a);
  EXPECT_EQ(fetched.size(), 2U);
  bring(a, 1);
  EXPECT_THAT(got, ElementsAre("the backend node did not answer in time", "version 1", "version 1"));
}

/// Would catch waiters that pile up, thirty a second for each visitor.
TEST_F(SharedStoreTest, WhoWaitsForABackendThatNeverAnswersIsNotKept) {
  for (int frame = 0; frame < 100; ++frame) get(a, -1.0);
  EXPECT_GE(got.size(), 99U);
}

/// A backend that answers on threads of its own, a store with room for a few, and many who use it: what they get is
/// what they asked for, and everybody gets it once.
TEST(SharedStoreThreads, EverybodyGetsWhatHeAskedForOnce) {
  constexpr int kThreads = 4;
  constexpr int kRounds = 500;
  constexpr int kKeys = 6;
  pipeline::WorkerPool backend(2);
  std::atomic<Version> version{1};
  std::atomic<SharedStore*> front{nullptr};
  SharedStore store(3 * 400, [&](const Request& request) {
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
