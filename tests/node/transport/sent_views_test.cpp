#include "node/transport/sent_views.h"

#include <gtest/gtest.h>

#include <memory>
#include <utility>

#include "node/messages/examples.h"

namespace grove::node {
namespace {

TEST(SentViews, KeepTheNewestOfEachSession) {
  SentViews views;
  for (FrameNumber frame = 1; frame <= 40; ++frame) {
    View view = examples::view();
    view.frame = frame;
    views.add(std::make_shared<View>(view));
  }
  const ViewLookup find = views.lookup();
  EXPECT_FALSE(find(examples::kSession, 8));
  ASSERT_TRUE(find(examples::kSession, 9));
  EXPECT_EQ(find(examples::kSession, 40)->frame, 40u);
  EXPECT_FALSE(find(examples::kSession + 1, 40));
  views.forget(examples::kSession);
  EXPECT_FALSE(find(examples::kSession, 40));
}

/// One whose lights make it a tenth of all that views may take.
std::shared_ptr<const View> largeView(SessionId session, FrameNumber frame = 1) {
  auto view = std::make_shared<View>();
  view->session = session;
  view->frame = frame;
  view->lights.resize(SentViews::kMaxBytes / 10 / sizeof(world::PointLight) - 100);
  return view;
}

TEST(SentViews, ForgetTheLongestSilent) {
  SentViews views;
  const ViewLookup find = views.lookup();
  for (SessionId session = 1; session <= 10; ++session) views.add(largeView(session));
  views.add(largeView(1, 2));
  EXPECT_TRUE(find(1, 2));
  EXPECT_TRUE(find(1, 1)) << "who speaks is not silent";
  EXPECT_FALSE(find(2, 1));
  EXPECT_TRUE(find(3, 1));
}

/// Or who sends views without end, and requests that hold them, takes all memory.
TEST(SentViews, HeldViewsCountWhileHeld) {
  SentViews views;
  const ViewLookup find = views.lookup();
  std::vector<std::shared_ptr<const View>> held;
  for (SessionId session = 1; session <= 100; ++session) {
    views.add(largeView(session));
    if (auto view = find(session, 1)) held.push_back(std::move(view));
  }
  EXPECT_EQ(held.size(), 10U);
  held.clear();
  views.add(largeView(101));
  EXPECT_TRUE(find(101, 1));
}

TEST(SentViews, MemoryIsBounded) {
  SentViews views;
  auto view = std::make_shared<View>();
  view->frame = 1;
  view->session = 1;
  const std::weak_ptr<const View> first = view;
  views.add(std::move(view));
  for (SessionId session = 2; !first.expired() && session < 1'000'000; ++session) {
    auto next = std::make_shared<View>();
    next->session = session;
    views.add(std::move(next));
  }
  EXPECT_TRUE(first.expired());
}

}  // namespace
}  // namespace grove::node
