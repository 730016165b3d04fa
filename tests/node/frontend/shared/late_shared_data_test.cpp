#include <gtest/gtest.h>

#include <future>
#include <vector>

#include "node/frontend/planner_stand.h"
#include "node/frontend/shared/shared_store_fixture.h"

namespace grove::node {
namespace {

ToFrontend welcomeOfLife(std::uint64_t epoch) {
  NodeWelcome welcome;
  welcome.epoch = epoch;
  welcome.objects.emplace_back().id = kObject;
  return welcome;
}

/// Shared data that waits for a worker while its node restarts or its link is restored.
class LateSharedData : public testing::PlannerStand {
 protected:
  /// Version 5 comes from a node of this epoch, then the node's next welcome, and only then a worker takes either.
  void bringBeforeWelcome(std::uint64_t epoch, std::uint64_t next) {
    process.receive(welcomeOfLife(epoch));
    workers.drain();
    process.shared().get(requestFor(own), [](const Payload&) {});
    std::promise<void> release;
    const std::shared_future<void> released = release.get_future().share();
    for (int i = 0; i < workers.width(); ++i) workers.postFirst([released] { released.wait(); });
    process.receive(ToFrontend(resultOf(own, 5)));
    process.receive(welcomeOfLife(next));
    release.set_value();
    workers.drain();
    ASSERT_EQ(backend.requests().size(), 1U);
    EXPECT_NE(process.shared().find(own), nullptr) << "shown meanwhile";
  }

  const SharedKey own{kObject, {}};
};

/// Would catch data of an earlier life that is taken for the node's own, and never fetched again.
TEST_F(LateSharedData, FromAnEarlierEpochIsFetchedWhole) {
  ASSERT_NO_FATAL_FAILURE(bringBeforeWelcome(1, 2));
  const std::vector<Request> requests = backend.requests();
  ASSERT_EQ(requests.size(), 2U);
  EXPECT_EQ(requests[1].known, 0U);
  EXPECT_EQ(process.shared().known(own), nullptr);
}

/// Would catch data whose change was announced while the link was lost.
TEST_F(LateSharedData, FromALostLinkIsFetchedAgain) {
  ASSERT_NO_FATAL_FAILURE(bringBeforeWelcome(1, 1));
  const std::vector<Request> requests = backend.requests();
  ASSERT_EQ(requests.size(), 2U);
  EXPECT_EQ(requests[1].known, 5U);
}

}  // namespace
}  // namespace grove::node
