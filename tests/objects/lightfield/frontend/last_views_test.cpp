#include "objects/lightfield/frontend/last_views.h"

#include <gtest/gtest.h>

namespace grove::objects::lightfield {
namespace {

CellId cellOf(std::int32_t column, std::int32_t version = 0) {
  CellId cell;
  cell.column = column;
  cell.version = version;
  return cell;
}

std::shared_ptr<const CachedView> picture() {
  return std::make_shared<const CachedView>(*raster::ImagePool().acquire({0, 0, 0, 0}), ObjectCamera());
}

TEST(LastViews, RemembersTheLastShown) {
  LastViews views;
  EXPECT_FALSE(views.last(5));
  views.shown(5, cellOf(7), 1.0, nullptr);
  views.shown(6, cellOf(8), 1.0, nullptr);
  EXPECT_EQ(views.last(5), cellOf(7));
  views.shown(5, cellOf(10), 2.0, nullptr);
  EXPECT_EQ(views.last(5), cellOf(10));
  EXPECT_EQ(views.last(6), cellOf(8));
}

TEST(LastViews, PicturesOfAReplacedLightFieldFade) {
  LastViews views;
  const auto former = picture();
  views.shown(5, cellOf(7), 1.0, nullptr);
  EXPECT_FALSE(views.fade(5, 1.1).from) << "there was nothing before";
  views.shown(5, cellOf(7, 1), 2.0, former);
  EXPECT_EQ(views.fade(5, 2.0).from, former);
  EXPECT_EQ(views.fade(5, 2.0).share, 0.0F) << "nothing jumps";
  // One who walks is shown other cells of the finer light field meanwhile.
  views.shown(5, cellOf(9, 1), 2.4, nullptr);
  float last = 0.0F;
  for (const double time : {2.25, 2.5, 2.75, 2.99}) {
    const CrossFade fade = views.fade(5, time);
    ASSERT_EQ(fade.from, former) << time;
    EXPECT_GT(fade.share, last);
    last = fade.share;
  }
  EXPECT_GT(last, 0.99F);
  EXPECT_FALSE(views.fade(5, 3.0).from);
  views.shown(5, cellOf(9, 1), 3.0, nullptr);
  EXPECT_EQ(former.use_count(), 1) << "and is given back";
}

TEST(LastViews, FadeEndsWithTheOldPicture) {
  LastViews views;
  views.shown(5, cellOf(7), 1.0, nullptr);
  views.shown(5, cellOf(7, 1), 2.0, picture());
  views.endFade(5);
  EXPECT_FALSE(views.fade(5, 2.1).from);
  EXPECT_EQ(views.last(5), cellOf(7, 1));
}

}  // namespace
}  // namespace grove::objects::lightfield
