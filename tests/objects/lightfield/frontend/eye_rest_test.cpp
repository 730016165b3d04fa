#include "objects/lightfield/frontend/eye_rest.h"

#include <gtest/gtest.h>

namespace grove::objects::lightfield {
namespace {

node::View viewAt(node::FrameNumber frame, double time, float x) {
  node::View view;
  view.frame = frame;
  view.time = time;
  view.camera.pose.position = {x, 1.7F, 0.0F};
  return view;
}

TEST(EyeRest, BeginsWhereTheEyeStops) {
  EyeRest rest;
  EXPECT_FALSE(rest.isAtRest());
  rest.see(viewAt(1, 10.0, 0.0F));
  EXPECT_FALSE(rest.isAtRest()) << "it has just arrived";
  rest.see(viewAt(2, 10.0 + 0.9 * EyeRest::kSeconds, 0.0F));
  EXPECT_FALSE(rest.isAtRest());
  rest.see(viewAt(3, 10.0 + EyeRest::kSeconds, 0.0F));
  EXPECT_TRUE(rest.isAtRest());
  rest.see(viewAt(4, 11.0, 0.01F));
  EXPECT_FALSE(rest.isAtRest());
}

TEST(EyeRest, HeadsMayTurn) {
  EyeRest rest;
  rest.see(viewAt(1, 1.0, 0.0F));
  node::View turned = viewAt(2, 2.0, 0.0F);
  turned.camera.pose.yaw = 1.0F;
  rest.see(turned);
  EXPECT_TRUE(rest.isAtRest());
}

/// Fails if the view of an extended backdrop, which is older, counts as a step.
TEST(EyeRest, IgnoresEarlierFrames) {
  EyeRest rest;
  rest.see(viewAt(5, 1.0, 2.0F));
  rest.see(viewAt(6, 2.0, 2.0F));
  rest.see(viewAt(4, 0.9, 1.9F));
  EXPECT_TRUE(rest.isAtRest());
}

}  // namespace
}  // namespace grove::objects::lightfield
