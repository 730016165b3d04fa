#include "node/transport/sent_views.h"

#include <gtest/gtest.h>

#include <memory>
#include <utility>

#include "node/messages/examples.h"

namespace grove::node {
namespace {

/// Adds views of one session, numbered from 1 on.
void addViews(SentViews& views, FrameNumber count, double secondsPerFrame) {
  for (FrameNumber frame = 1; frame <= count; ++frame) {
    View view = examples::view();
    view.frame = frame;
    view.time = static_cast<double>(frame) * secondsPerFrame;
    views.add(std::make_shared<View>(view));
  }
}

TEST(SentViews, KeepTheNewestOfEachSession) {
  SentViews views;
  addViews(views, 600, 1.0 / 30.0);
  const ViewLookup find = views.lookup();
  EXPECT_FALSE(find(examples::kSession, 400));
  EXPECT_EQ(find(examples::kSession, 600)->frame, 600u);
  EXPECT_FALSE(find(examples::kSession + 1, 600));
  views.forget(examples::kSession);
  EXPECT_FALSE(find(examples::kSession, 600));
}

/// Fails if a visitor who looks around for three seconds waits for pictures whose requests are refused, because they
/// name the view of a backdrop that is being extended.
TEST(SentViews, KnowTheViewOfABackdropAsLongAsItServes) {
  for (const double framesPerSecond : {5.0, 30.0, 60.0}) {
    SentViews views;
    addViews(views, 1000, 1.0 / framesPerSecond);
    EXPECT_TRUE(views.lookup()(examples::kSession, 1000 - static_cast<FrameNumber>(kMaxBackdropAge * framesPerSecond)))
        << framesPerSecond;
  }
}

/// Fails if a link whose views have no time keeps all of them.
TEST(SentViews, KeepABoundedNumber) {
  SentViews views;
  addViews(views, SentViews::kMostKept + 1, 0.0);
  EXPECT_FALSE(views.lookup()(examples::kSession, 1));
  EXPECT_TRUE(views.lookup()(examples::kSession, 2));
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
