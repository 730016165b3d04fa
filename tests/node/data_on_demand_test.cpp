#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "eventually.h"
#include "node/nodes_fixture.h"

namespace grove::node {
namespace {

using pipeline::Reuse;
using testing::Screen;
using tests::eventually;

/// Boxes of whose colours each is shared data under a key that depends on the view, as a light field's is.
class DataOnDemand : public testing::Nodes {
 protected:
  DataOnDemand() : Nodes(testing::BoxAsks::kOfView) {}

  /// A visitor who looks along `yaw` gets two frames.
  void look(std::uint32_t visitor, float yaw) {
    const auto screen = std::make_shared<Screen>(workers, timeline);
    const auto node = frontend(visitor, yaw, screen);
    for (FrameNumber frame = 1; frame <= 2; ++frame) {
      ASSERT_TRUE(eventually([&] { return node->requestFrame(); }));
      ASSERT_TRUE(screen->waitFor(frame));
    }
    workers.drain();
  }
  Reuse counted() { return timeline.reuse()["box"]; }
};

constexpr float kAhead = 0.0F;
constexpr float kAside = 0.02F;

/// Would catch a visitor's own reuse that counts as sharing.
TEST_P(DataOnDemand, IsOfWhoLooksWhereNobodyElseDoes) {
  look(1, kAhead);
  look(2, kAside);
  const Reuse reuse = counted();
  EXPECT_EQ(reuse.made, 4U) << "two boxes for each";
  EXPECT_EQ(reuse.used, 4U);
  EXPECT_EQ(reuse.shared, 0U);
  EXPECT_EQ(reuse.usesAgain, 4U);
  EXPECT_EQ(reuse.usesByOthers, 0U);
}

/// Would catch data that each of its users makes shared, and one whose other users are not told apart from the first.
TEST_P(DataOnDemand, IsSharedByTheSecondWhoUsesIt) {
  look(1, kAhead);
  look(2, kAhead);
  look(3, kAhead);
  const Reuse reuse = counted();
  EXPECT_EQ(reuse.made, 2U);
  EXPECT_EQ(reuse.used, 2U);
  EXPECT_EQ(reuse.shared, 2U);
  EXPECT_EQ(reuse.sharedBytes, reuse.madeBytes);
  EXPECT_EQ(reuse.usesAgain, 2U);
  EXPECT_EQ(reuse.usesByOthers, 8U);
}

/// Would catch memory of views that stands under work that depends on nobody.
TEST_P(DataOnDemand, ThatCameAsBytesIsHeldApart) {
  look(1, kAhead);
  for (const auto& [key, total] : frontendMemory.totals()) {
    if (key.holder == "shared store, on demand") {
      EXPECT_EQ(total.work, pipeline::Work::kOnDemand);
    }
    EXPECT_NE(key.holder, "shared store");
  }
}

class DataOfAllVisitors : public testing::Nodes {
 protected:
  DataOfAllVisitors() : Nodes(testing::BoxAsks::kShared) {}
};

/// Would catch maps and ticks that count as reused views.
TEST_P(DataOfAllVisitors, IsNotOnDemand) {
  const auto screen = std::make_shared<Screen>(workers, timeline);
  const auto node = frontend(1, 0.0F, screen);
  ASSERT_TRUE(node->requestFrame());
  ASSERT_TRUE(screen->waitFor(1));
  workers.drain();
  EXPECT_TRUE(timeline.reuse().empty());
}

INSTANTIATE_TEST_SUITE_P(OverBoth, DataOnDemand, testing::kBothInMemory, testing::transportName);
INSTANTIATE_TEST_SUITE_P(OverBoth, DataOfAllVisitors, testing::kBothInMemory, testing::transportName);

}  // namespace
}  // namespace grove::node
