#include "node/frontend/compositing/fresh_parts.h"

#include <gmock/gmock.h>

namespace grove::node {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using world::Rect;

constexpr Rect kFrame{0, 0, 600, 20};

TEST(FreshParts, AreTheOverdrawnStrips) {
  const FreshParts fresh(kFrame, {{10, 9, 11, 10}});
  EXPECT_FALSE(fresh.isFresh(0, 0));
  EXPECT_TRUE(fresh.isFresh(0, 8));
  EXPECT_FALSE(fresh.isFresh(256, 8));
  EXPECT_FALSE(fresh.isFresh(0, 16));
  EXPECT_THAT(fresh.strips(), ElementsAre(Rect{0, 8, 256, 16}));
  const std::vector<raster::Span> spans = fresh.spans();
  ASSERT_EQ(spans.size(), 20U);
  EXPECT_GE(spans[7].begin, spans[7].end);
  EXPECT_EQ(spans[8].begin, 0);
  EXPECT_EQ(spans[15].end, 256);
  EXPECT_GE(spans[16].begin, spans[16].end);
}

TEST(FreshParts, MergeNeighboursAndClip) {
  EXPECT_THAT(FreshParts(kFrame, {{255, 0, 257, 8}, {520, 17, 521, 18}}).strips(),
              ElementsAre(Rect{0, 0, 512, 8}, Rect{512, 16, 600, 20}));
  EXPECT_THAT(FreshParts(kFrame, {kFrame}).strips(),
              ElementsAre(Rect{0, 0, 600, 8}, Rect{0, 8, 600, 16}, Rect{0, 16, 600, 20}));
}

TEST(FreshParts, StayWithinTheFrame) {
  EXPECT_THAT(FreshParts(kFrame, {{-50, -10, 0, 30}, {600, 0, 700, 20}, {100, 5, 100, 9}, {}}).strips(), IsEmpty());
  EXPECT_THAT(FreshParts(kFrame, {{-50, -10, 1, 1}}).strips(), ElementsAre(Rect{0, 0, 256, 8}));
}

}  // namespace
}  // namespace grove::node
