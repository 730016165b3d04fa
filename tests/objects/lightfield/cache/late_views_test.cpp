#include "objects/lightfield/cache/late_views.h"

#include <gtest/gtest.h>

namespace grove::objects::lightfield {
namespace {

using world::Vec3;

std::shared_ptr<const CachedView> pictureFrom(Vec3 eye) {
  static node::ImagePool pool;
  const auto image = pool.acquire({0, 0, 4, 4});
  std::ranges::fill(image->colour, 0xFFFFFFFFU);
  std::ranges::fill(image->depth, 2.0F);
  ObjectCamera camera;
  camera.eye = eye;
  return std::make_shared<const CachedView>(*image, camera);
}

node::View viewOf(node::SessionId session, node::FrameNumber frame) {
  node::View view;
  view.session = session;
  view.frame = frame;
  return view;
}

class LateViewsTest : public testing::Test {
 protected:
  LateViewsTest() {
    cell_.reach = 0.5F;
    for (world::ObjectId object = 1; object <= 10; ++object) late_.shown(viewOf(1, 1), object, picture_);
  }

  std::shared_ptr<const CachedView> picture_ = pictureFrom({0, 0, 10});
  ViewCell cell_;
  LateViews late_;
};

TEST_F(LateViewsTest, OnlySomePicturesOfAFrameAreNew) {
  for (node::FrameNumber frame = 2; frame < 5; ++frame) {
    int made = 0;
    for (world::ObjectId object = 1; object <= 10; ++object) {
      made += late_.lateView(viewOf(1, frame), object, cell_, {0.6F, 0, 10}) ? 0 : 1;
    }
    EXPECT_EQ(made, LateViews::kMostNewPictures);
  }
}

TEST_F(LateViewsTest, ALatePictureIsTheOneThatWasShown) {
  for (world::ObjectId object = 1; object <= 3; ++object) {
    EXPECT_FALSE(late_.lateView(viewOf(1, 2), object, cell_, {0.6F, 0, 10}));
  }
  EXPECT_EQ(late_.lateView(viewOf(1, 2), 4, cell_, {0.6F, 0, 10}), picture_);
}

TEST_F(LateViewsTest, WhatIsTooFarOffOrUnknownIsMadeAnew) {
  for (world::ObjectId object = 1; object <= 3; ++object) {
    EXPECT_FALSE(late_.lateView(viewOf(1, 2), object, cell_, {0.6F, 0, 10}));
  }
  EXPECT_FALSE(late_.lateView(viewOf(1, 2), 4, cell_, {1.6F, 0, 10}));
  EXPECT_FALSE(late_.lateView(viewOf(1, 2), 11, cell_, {0.6F, 0, 10}));
}

TEST_F(LateViewsTest, VisitorsHaveTheirOwnBudgets) {
  for (world::ObjectId object = 1; object <= 10; ++object) late_.shown(viewOf(2, 1), object, picture_);
  for (world::ObjectId object = 1; object <= 3; ++object) {
    EXPECT_FALSE(late_.lateView(viewOf(1, 2), object, cell_, {0.6F, 0, 10}));
    EXPECT_FALSE(late_.lateView(viewOf(2, 2), object, cell_, {0.6F, 0, 10}));
  }
}

TEST_F(LateViewsTest, PicturesAreNotKeptAlive) {
  for (world::ObjectId object = 1; object <= 3; ++object) {
    EXPECT_FALSE(late_.lateView(viewOf(1, 2), object, cell_, {0.6F, 0, 10}));
  }
  const std::weak_ptr<const CachedView> watched = picture_;
  picture_.reset();
  EXPECT_TRUE(watched.expired());
  EXPECT_FALSE(late_.lateView(viewOf(1, 2), 4, cell_, {0.6F, 0, 10}));
}

TEST_F(LateViewsTest, MemoryIsBoundedWhoeverComes) {
  for (node::SessionId session = 1; session < 3000; ++session) {
    for (world::ObjectId object = 1; object <= 10; ++object) late_.shown(viewOf(session, 1), object, picture_);
  }
  for (world::ObjectId object = 1; object <= 4; ++object) {
    EXPECT_FALSE(late_.lateView(viewOf(1, 9), object, cell_, {0.6F, 0, 10})) << "the first visitors are forgotten";
  }
}

}  // namespace
}  // namespace grove::objects::lightfield
