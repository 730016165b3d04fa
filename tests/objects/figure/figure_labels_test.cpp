#include "objects/figure/frontend/figure_labels.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "objects/figure/common/stature.h"
#include "objects/figure/visitors_in_sight.h"

namespace grove::objects::figure {
namespace {

/// A frame of one depth, with something at another depth from a column on.
class LabelTest : public testing::Test {
 protected:
  std::optional<node::Label> labelIn(const world::Object& object, float depth, float other, int from) {
    const auto list = look({object}, {});
    colour_.assign(320 * 180, 0xFF808080);
    depth_.assign(320 * 180, depth);
    for (std::size_t i = 0; i < depth_.size(); ++i) {
      if (static_cast<int>(i % 320) >= from) depth_[i] = other;
    }
    const raster::Image frame{{0, 0, 320, 180}, colour_, depth_, false, {}};
    const auto layer = labels_.layer(list->objects[0], {}, *list->view);
    return layer->label(frame);
  }
  /// Under the open sky.
  std::optional<node::Label> labelOfOne(const world::Object& object) {
    return labelIn(object, world::kInfiniteDepth, world::kInfiniteDepth, 320);
  }

  FigureLabels labels_;
  std::vector<std::uint32_t> colour_;
  std::vector<float> depth_;
};

TEST_F(LabelTest, StandsAboveTheHead) {
  const auto label = labelOfOne(visitor(1, {0.5F, 0, -6}));
  ASSERT_TRUE(label);
  EXPECT_EQ(label->object, world::kFirstPlayerObject + 1);
  EXPECT_FLOAT_EQ(label->opacity, 1.0F);
  EXPECT_NEAR(label->depth, 6.0F, 0.01F);
  // The taller of two: his head is where his body is drawn.
  const world::Camera camera = look({}, {})->view->camera;
  const float hood = kFigureHeight * kStatures[1].height;
  const world::Vec3 head = camera.project({0.5F, hood, -6});
  EXPECT_NEAR(label->place.x, head.x, 0.5F);
  EXPECT_LT(label->place.y, head.y);
  EXPECT_GT(label->place.y, camera.project({0.5F, hood + 0.2F, -6}).y);
  const auto smaller = labelOfOne(visitor(2, {0.5F, 0, -6}));
  ASSERT_TRUE(smaller);
  EXPECT_GT(smaller->place.y, label->place.y + 2.0F);
}

TEST_F(LabelTest, IsVisibleIfTheHeadIs) {
  const world::Object ada = visitor(1, {0, 0, -6});
  EXPECT_FALSE(labelIn(ada, 3.0F, 3.0F, 0)) << "behind a wall";
  const auto half = labelIn(ada, world::kInfiniteDepth, 3.0F, 160);
  ASSERT_TRUE(half);
  EXPECT_NEAR(half->opacity, 0.5F, 0.2F);
  const auto own = labelIn(ada, 5.8F, 5.8F, 0);
  ASSERT_TRUE(own) << "the figure's own face is nearer than its middle";
  EXPECT_FLOAT_EQ(own->opacity, 1.0F);
}

/// Fails if a name is hidden by depths that were never written.
TEST_F(LabelTest, ReadsDepthOnlyWithinItsRectangle) {
  const world::Object ada = visitor(1, {0, 0, -6});
  const auto list = look({ada}, {});
  const world::Rect reads = labels_.layer(list->objects[0], {}, *list->view)->reach({});
  ASSERT_FALSE(reads.empty());
  colour_.assign(320 * 180, 0);
  depth_.assign(320 * 180, 0.2F);
  for (int y = reads.top; y < reads.bottom; ++y) {
    std::fill_n(depth_.begin() + std::ptrdiff_t{y} * 320 + reads.left, reads.width(), world::kInfiniteDepth);
  }
  const auto label = labelOf(ada, list->view->camera, {{0, 0, 320, 180}, colour_, depth_, false, {}});
  ASSERT_TRUE(label);
  EXPECT_FLOAT_EQ(label->opacity, 1.0F);
}

TEST_F(LabelTest, OwnNameIsNotShown) {
  const auto list = look({visitor(1, {0, 0, -4})}, {});
  node::View view = *list->view;
  EXPECT_NE(labels_.layer(list->objects[0], {}, view), nullptr);
  view.viewer = 1;
  EXPECT_EQ(labels_.layer(list->objects[0], {}, view), nullptr);
}

TEST_F(LabelTest, FadesWithDistance) {
  const auto far = labelOfOne(visitor(1, {0, 0, -22}));
  ASSERT_TRUE(far);
  EXPECT_GT(far->opacity, 0.1F);
  EXPECT_LT(far->opacity, 0.9F);
  EXPECT_FALSE(labelOfOne(visitor(1, {0, 0, -26})));
  EXPECT_FALSE(labelOfOne(visitor(1, {0, 0, 5}))) << "behind the eye";
}

TEST_F(LabelTest, StaysWithinTheFrame) {
  const auto near = labelOfOne(visitor(1, {0, 0.5F, -0.9F}));
  ASSERT_TRUE(near);
  EXPECT_FLOAT_EQ(near->place.y, 0.0F) << "the head touches the upper edge";
  EXPECT_FALSE(labelOfOne(visitor(1, {20, 0, -4}))) << "beside the frame";
}

TEST_F(LabelTest, NoNameNoLabel) {
  world::Object nobody = visitor(1, {0, 0, -6});
  nobody.name.clear();
  EXPECT_FALSE(labelOfOne(nobody));
}

}  // namespace
}  // namespace grove::objects::figure
