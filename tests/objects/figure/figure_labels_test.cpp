#include "objects/figure/frontend/figure_labels.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "objects/figure/visitors_in_sight.h"

namespace grove::objects::figure {
namespace {

/// A frame of one grey, at one depth.
class LabelTest : public testing::Test {
 protected:
  static constexpr std::uint32_t kGrey = 0xFF808080;

  std::size_t touched(const world::Object& object, float depth) {
    const auto list = look({object}, {});
    colour_.assign(320 * 180, kGrey);
    depth_.assign(320 * 180, depth);
    // The left half is open sky.
    for (std::size_t y = 0; y < 180; ++y)
      std::fill_n(depth_.begin() + static_cast<std::ptrdiff_t>(y * 320), 160, 1.0e30F);
    raster::Image frame{{0, 0, 320, 180}, colour_, depth_, false, {}};
    labels_.draw(list->objects[0].object, list->view->camera, frame);
    return static_cast<std::size_t>(std::ranges::count_if(colour_, [](std::uint32_t c) { return c != kGrey; }));
  }

  FigureLabels labels_;
  std::vector<std::uint32_t> colour_;
  std::vector<float> depth_;
};

TEST_F(LabelTest, IsDrawnOnlyWhereNothingStandsBeforeIt) {
  const std::size_t all = touched(visitor(1, {0, 0, -6}), 20.0F);
  EXPECT_GT(all, 200U);
  const std::size_t half = touched(visitor(1, {0, 0, -6}), 3.0F);
  EXPECT_GT(half, all / 4);
  EXPECT_LT(half, all * 3 / 4);
  for (std::size_t y = 0; y < 180; ++y) {
    for (std::size_t x = 160; x < 320; ++x) ASSERT_EQ(colour_[y * 320 + x], kGrey);
  }
}

/// Fails if a long name is hidden by depths that were never written.
TEST_F(LabelTest, ReadsDepthWhereverItIsDrawn) {
  world::Object ada = visitor(1, {0, 0, -15});
  ada.name = "a name that is far wider than its figure";
  const auto list = look({ada}, {});
  const node::VisibleObject& object = list->objects[0];
  const world::Rect reads = labels_.layer(object, {}, *list->view)->readsDepth({0, 0, 320, 180});
  EXPECT_GT(reads.width(), object.rect.width());
  ASSERT_GT(touched(ada, world::kInfiniteDepth), 0U);
  for (int y = 0; y < 180; ++y) {
    for (int x = 0; x < 320; ++x) {
      if (colour_.data()[std::ptrdiff_t{y} * 320 + x] == kGrey) continue;
      ASSERT_FALSE(world::overlap(reads, {x, y, x + 1, y + 1}).empty()) << x << ", " << y;
    }
  }
}

TEST_F(LabelTest, NobodyReadsHisOwnName) {
  const auto list = look({visitor(1, {0, 0, -4})}, {});
  node::View view = *list->view;
  EXPECT_NE(labels_.layer(list->objects[0], {}, view), nullptr);
  view.viewer = 1;
  EXPECT_EQ(labels_.layer(list->objects[0], {}, view), nullptr);
}

TEST_F(LabelTest, FadesWithDistance) {
  const auto brightest = [&] {
    return *std::ranges::max_element(colour_, {}, [](std::uint32_t c) { return c & 0xFFU; }) & 0xFFU;
  };
  (void)touched(visitor(1, {0, 0, -8}), 1.0e30F);
  const std::uint32_t near = brightest();
  (void)touched(visitor(1, {0, 0, -20}), 1.0e30F);
  EXPECT_LT(brightest(), near);
  EXPECT_EQ(touched(visitor(1, {0, 0, -26}), 1.0e30F), 0U);
  EXPECT_EQ(touched(visitor(1, {0, 0, 5}), 1.0e30F), 0U);
}

TEST(LabelFont, DrawsAnyBytes) {
  const LabelFont font;
  EXPECT_GT(font.draw("wide name", 18).width, font.draw("i", 18).width);
  const LabelMask broken = font.draw("\xFF\xC3", 18);
  EXPECT_TRUE(std::ranges::any_of(broken.coverage, [](std::uint8_t c) { return c > 0; }));
  EXPECT_LT(font.draw(std::string(10'000, 'W'), 18).width, 1000);
}

}  // namespace
}  // namespace grove::objects::figure
