#include "stream/session/headless_session.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <memory>

#include "eventually.h"
#include "integration/picture.h"
#include "integration/served_scene.h"
#include "pipeline/clocks.h"

namespace grove::integration {
namespace {

using stream::HeadlessSession;
using tests::eventually;

constexpr double kPushed = 0.02;  // share of the picture's width; the plume wanders by 0.01, a gust pushes it by 0.05

/// Stones around a fire before a black sky: nothing but the simulation and the visitors moves.
const std::string kScene = R"(
name = "test clearing"
spawn = [0, 0, 9]
[visitor]
type = "figure"
[[object]]
type = "mesh"
shape = "stone"
position = [-3, 0, 0]
[[object]]
type = "fluid"
size = 4
grid = 16
wind = [0, 0, 0]
)";

class HeadlessSessions : public ::testing::Test {
 protected:
  /// Of who came first.
  world::Vec3 position() { return served.host.players().all(pipeline::wallSeconds()).front().pose.position; }

  ServedScene served{kScene};
};

TEST_F(HeadlessSessions, TwoCamerasSeeOneWorld) {
  HeadlessSession a(served.host, "a", 320, 180);
  HeadlessSession b(served.host, "b", 320, 180);
  const Picture ahead = pictureAfter(a, 0, 0.0F);
  const Picture beside = pictureAfter(b, 0, 0.0F);
  const Picture away = pictureAfter(b, 0, 3.14F);
  EXPECT_GT(ahead.mean(), 3.0) << "the fire and the stone are there";
  EXPECT_GT(beside.mean(), 3.0);
  EXPECT_LT(away.mean(), 0.3 * beside.mean()) << "nothing is there";
  EXPECT_GT(difference(ahead, beside), 1.0);
}

TEST_F(HeadlessSessions, FramesFollowResizes) {
  HeadlessSession a(served.host, "a", 320, 180);
  EXPECT_EQ(pictureAfter(a, 0, 0.0F).width, 320);
  ASSERT_FALSE(a.session().resize({640, 360}).has_value());
  std::shared_ptr<const stream::EncodedFrame> frame;
  for (int i = 0; i < 100 && (!frame || frame->header.width != 640); ++i) {
    frame = a.frameAfter(frame ? frame->header.frame : 0, kPatience);
    ASSERT_TRUE(frame);
  }
  EXPECT_EQ(frame->header.width, 640);
  EXPECT_EQ(decode(frame).height, 360);
}

TEST_F(HeadlessSessions, WalkingChangesTheView) {
  HeadlessSession a(served.host, "a", 320, 180);
  const world::Vec3 from = position();
  const Picture before = pictureAfter(a, 0, 0.0F);
  (void)pictureAfter(a, world::kForward | world::kRun, 0.0F);
  EXPECT_TRUE(eventually([&] { return position().z < from.z - 2.0F; }));
  EXPECT_GT(difference(before, pictureAfter(a, 0, 0.0F)), 2.0);
}

TEST_F(HeadlessSessions, GustsAreSeenByOthers) {
  HeadlessSession blower(served.host, "blower", 160, 90);
  HeadlessSession witness(served.host, "witness", 320, 180);
  // The blower walks to the east of the fire and blows westwards, to the left of who looks north.
  (void)pictureAfter(blower, world::kRight | world::kRun, 0.0F);
  const world::Vec3 from = position();
  ASSERT_TRUE(eventually([&] { return position().x > from.x + 4.0F; }));
  (void)pictureAfter(blower, world::kForward | world::kRun, 0.0F);
  ASSERT_TRUE(eventually([&] { return position().z < 2.0F; }));
  (void)pictureAfter(blower, 0, 0.0F);
  const world::Vec3 at = position();
  const float towardsFire = std::atan2(at.x, at.z);
  // The plume wanders by itself, so the gust has to push it farther than it ever went.
  const auto plume = [&] { return pictureAfter(witness, 0, 0.0F).middle(0.3, 0.7); };
  double farthest = 1.0;
  for (int i = 0; i < 30; ++i) farthest = std::min(farthest, plume());
  (void)pictureAfter(blower, world::kBlow, towardsFire, 0.0F);
  EXPECT_TRUE(eventually([&] { return plume() < farthest - kPushed; }));
}

TEST_F(HeadlessSessions, VisitorsSeeEachOther) {
  HeadlessSession a(served.host, "a", 320, 180);
  const float towardsNeighbour = -1.5708F;  // arrivals stand side by side, the second to the left of the first
  Picture alone = pictureAfter(a, 0, -towardsNeighbour);
  HeadlessSession b(served.host, "b", 320, 180);
  (void)pictureAfter(b, 0, 0.0F);
  const Picture together = pictureAfter(a, 0, -towardsNeighbour);
  EXPECT_GT(difference(alone, together), 5.0);
}

TEST_F(HeadlessSessions, WithoutAcknowledgementsTwoFramesAreSent) {
  const auto frames = std::make_shared<std::atomic<int>>(0);  // a run in progress may outlast this function
  auto opened = served.host.open({"silent", 160, 90},
                                 [frames](const std::shared_ptr<const stream::EncodedFrame>&) { ++*frames; });
  auto silent = std::get<std::shared_ptr<stream::Session>>(opened);
  HeadlessSession lively(served.host, "lively", 160, 90);
  const auto first = lively.frameAfter(0, kPatience);
  ASSERT_TRUE(first);
  ASSERT_TRUE(lively.frameAfter(first->header.frame + 20, kPatience)) << "the other visitor is not held up";
  EXPECT_GE(*frames, 1);
  EXPECT_LE(*frames, 2);
  silent->close();
}

TEST_F(HeadlessSessions, LeavingFreesAPlace) {
  for (int i = 0; i < 40; ++i) {
    const HeadlessSession visitor(served.host, "", 160, 90);
    EXPECT_EQ(served.host.visitors(), 1u);
  }
  EXPECT_EQ(served.host.visitors(), 0u);
  EXPECT_EQ(served.host.players().count(), 0u);
}

TEST(FitSize, KeepsTheShapeWithinBounds) {
  using stream::fitSize;
  EXPECT_EQ(fitSize(1280, 720), (std::pair{1280, 720}));
  EXPECT_EQ(fitSize(3840, 2160), (std::pair{1920, 1080}));
  EXPECT_EQ(fitSize(2000, 2000), (std::pair{1080, 1080}));
  EXPECT_EQ(fitSize(16, 16), (std::pair{160, 160}));
  EXPECT_EQ(fitSize(1001, 701), (std::pair{1000, 700}));
  const auto strip = fitSize(16384, 16);
  EXPECT_LE(strip.first, 1920);
  EXPECT_GE(strip.second, 90);
}

}  // namespace
}  // namespace grove::integration
