#include "objects/lightfield/frontend/near_views.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "objects/lightfield/frontend/near_cameras.h"

namespace grove::objects::lightfield {
namespace {

using world::Rect;
using world::Vec3;

/// A wall at `far` metres behind a grating of bars at `near` metres.
std::shared_ptr<const CachedView> gratingOf(float near, float far) {
  static raster::ImagePool pool;
  const auto image = pool.acquire({0, 0, kPictureSize, kPictureSize});
  std::ranges::fill(image->colour, 0xFFFFFFFFU);
  for (int y = 0; y < kPictureSize; ++y) {
    for (int x = 0; x < kPictureSize; ++x) image->depthRow(y)[x] = x / 4 % 2 == 0 ? near : far;
  }
  return std::make_shared<const CachedView>(*image, turnedCamera(Vec3(0.0F)));
}

/// The frame is the middle of what is sampled, eight pixels less on each side.
constexpr Rect kSampled{0, 0, kPictureSize, kPictureSize};
constexpr Rect kFrame{8, 8, kPictureSize - 8, kPictureSize - 8};

bool serves(const NearView& view, const ObjectCamera& camera, const Rect& rect, float errorPixels) {
  return reprojectionError(view, camera, rect, 1.0F) <= errorPixels;
}

NearView viewOf(std::shared_ptr<const CachedView> picture) {
  NearView view{.sampled = kSampled, .roughness = roughness(*picture), .edges = edgeNearness(*picture, kSampled)};
  view.picture = std::move(picture);
  return view;
}

TEST(NearViews, RoughnessIsTheDepthOfTheEdges) {
  EXPECT_NEAR(roughness(*gratingOf(2.0F, 2.0F)), 0.0F, 1e-5F);
  // The picture's border has the depth of what it is beside, so its squares are no edges.
  EXPECT_NEAR(roughness(*gratingOf(2.0F, 4.0F)), 0.25F, 0.01F);
  EXPECT_NEAR(roughness(*gratingOf(1.0F, 4.0F)), 0.75F, 0.03F);
}

TEST(NearViews, ServesUntilEdgesUncoverTooMuch) {
  const NearView view = viewOf(gratingOf(2.0F, 4.0F));
  // From 0.1 metres aside, the bars uncover 80 * 0.1 * (1 / 2 - 1 / 4) = 2 pixels.
  const ObjectCamera aside = turnedCamera({0.1F, 0.0F, 0.0F});
  EXPECT_TRUE(serves(view, aside, kFrame, 2.1F));
  EXPECT_FALSE(serves(view, aside, kFrame, 1.9F));
  EXPECT_TRUE(serves(viewOf(gratingOf(2.0F, 2.0F)), aside, kFrame, 0.1F)) << "a wall uncovers nothing";
}

TEST(NearViews, ServesAHeadThatTurnsWithinTheMargin) {
  const NearView view = viewOf(gratingOf(2.0F, 4.0F));
  EXPECT_TRUE(serves(view, turnedCamera(Vec3(0.0F)), kFrame, 0.0F));
  EXPECT_TRUE(serves(view, turnedCamera(Vec3(0.0F), 0.06F), kFrame, 0.0F));
  EXPECT_FALSE(serves(view, turnedCamera(Vec3(0.0F), 0.15F), kFrame, 0.0F)) << "what is beyond was not sampled";
  EXPECT_FALSE(serves(view, turnedCamera(Vec3(0.0F), 3.1F), kFrame, 100.0F)) << "it is behind";
}

TEST(NearViews, DoesNotServeBeyondTheEdge) {
  const NearView view = viewOf(gratingOf(2.0F, 4.0F));
  // 80 * 0.3 / 2 = 12 pixels of the near bars.
  EXPECT_FALSE(serves(view, turnedCamera({0.3F, 0.0F, 0.0F}), kFrame, 100.0F));
  EXPECT_TRUE(serves(view, turnedCamera({0.15F, 0.0F, 0.0F}), kFrame, 100.0F));
}

/// A wall in some columns of the picture, at one depth in its left half and at another in its right half.
std::shared_ptr<const CachedView> wallOf(int begin, int end, float left, float right) {
  static raster::ImagePool pool;
  const auto image = pool.acquire({0, 0, kPictureSize, kPictureSize});
  std::ranges::fill(image->colour, 0U);
  std::ranges::fill(image->depth, world::kInfiniteDepth);
  for (int y = 0; y < kPictureSize; ++y) {
    for (int x = begin; x < end; ++x) {
      image->colourRow(y)[x] = 0xFFFFFFFFU;
      image->depthRow(y)[x] = x < kPictureSize / 2 ? left : right;
    }
  }
  return std::make_shared<const CachedView>(*image, turnedCamera(Vec3(0.0F)));
}

TEST(NearViews, EdgesHaveTheNearestDepth) {
  const Sides edges = edgeNearness(*wallOf(0, kPictureSize, 2.0F, 10.0F), kSampled);
  EXPECT_FLOAT_EQ(edges.left, 0.5F);
  EXPECT_FLOAT_EQ(edges.right, 0.1F);
  EXPECT_FLOAT_EQ(edges.top, 0.5F);
  EXPECT_FLOAT_EQ(edges.bottom, 0.5F);
}

/// Fails if a picture is made anew because the head turns to where the object is not.
TEST(NearViews, ServesAnyTurnAroundAContainedObject) {
  const NearView view = viewOf(wallOf(0, kPictureSize - 20, 2.0F, 2.0F));
  EXPECT_EQ(view.edges.right, kObjectEnds);
  EXPECT_TRUE(serves(view, turnedCamera(Vec3(0.0F), -0.3F), {8, 30, kPictureSize - 8, kPictureSize - 30}, 0.0F));
  EXPECT_FALSE(serves(view, turnedCamera(Vec3(0.0F), 0.3F), {8, 30, kPictureSize - 8, kPictureSize - 30}, 0.0F));
  EXPECT_FALSE(serves(view, turnedCamera(Vec3(0.0F), -0.3F), {8, 1, kPictureSize - 8, kPictureSize - 1}, 0.0F))
      << "above and below it";
}

/// Fails if the nearest of the whole picture decides what may lie beyond its farthest edge.
TEST(NearViews, FarEdgesServeLonger) {
  const NearView view = viewOf(wallOf(0, kPictureSize, 0.5F, 10.0F));
  const Rect right{kPictureSize / 2, 40, kPictureSize - 8, kPictureSize - 40};
  // 80 * 0.2 / 10 = 1.6 pixels, but 32 of what is near.
  EXPECT_TRUE(serves(view, turnedCamera({0.2F, 0.0F, 0.0F}), right, 100.0F));
}

TEST(NearViews, KeepsTheLastOfEachObject) {
  NearViews views;
  EXPECT_FALSE(views.last(1).picture);
  const NearView one = viewOf(gratingOf(2.0F, 4.0F));
  const NearView other = viewOf(gratingOf(1.0F, 4.0F));
  views.shown(1, one);
  views.shown(2, other);
  EXPECT_EQ(views.last(1).picture, one.picture);
  EXPECT_EQ(views.last(2).picture, other.picture);
  views.shown(1, other);
  EXPECT_EQ(views.last(1).picture, other.picture);
}

TEST(NearViews, MemoryIsBoundedHoweverManyObjects) {
  NearViews views;
  const NearView view = viewOf(gratingOf(2.0F, 4.0F));
  for (world::ObjectId object = 1; object <= 1000; ++object) {
    views.shown(object, view);
    (void)views.last(1);
  }
  EXPECT_TRUE(views.last(1).picture) << "the first is still in use";
  EXPECT_FALSE(views.last(2).picture);
  EXPECT_TRUE(views.last(1000).picture);
  EXPECT_LE(view.picture.use_count(), static_cast<long>(NearViews::kMax) + 1);
  EXPECT_EQ(views.bytes(), NearViews::kMax * view.picture->bytes());
}

TEST(NearViews, ReportTheirMemory) {
  NearViews views;
  const NearView view = viewOf(gratingOf(2.0F, 4.0F));
  const std::size_t each = view.picture->bytes();
  views.shown(1, view);
  views.shown(2, view);
  EXPECT_EQ(views.bytes(), 2 * each);
  views.shown(1, view);
  EXPECT_EQ(views.bytes(), 2 * each) << "in place of the last one";
}

TEST(NearViews, KeepsPicturesOfAReplacedLightFieldWhileFading) {
  NearViews views;
  const NearView coarse = viewOf(gratingOf(2.0F, 4.0F));
  views.shown(5, coarse);
  const std::size_t alone = views.bytes();
  NearView finer = viewOf(gratingOf(2.0F, 4.0F));
  finer.version = 1;
  finer.from = coarse.picture;
  finer.since = 10.0;
  views.shown(5, finer);
  EXPECT_EQ(views.bytes(), 2 * alone);
  EXPECT_EQ(unlessFaded(views.last(5), 10.5).from, coarse.picture);
  views.shown(5, unlessFaded(views.last(5), 10.0 + CrossFade::kSeconds));
  EXPECT_EQ(views.last(5).from, nullptr);
  EXPECT_EQ(views.bytes(), alone);
}

}  // namespace
}  // namespace grove::objects::lightfield
