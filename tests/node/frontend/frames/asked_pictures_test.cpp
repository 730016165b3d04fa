#include "node/frontend/frames/asked_pictures.h"

#include <gtest/gtest.h>

#include <memory>

namespace grove::node {
namespace {

constexpr world::Rect kRect{1, 2, 30, 40};

Request asking(SessionId session, FrameNumber frame, std::uint32_t slot) {
  View view;
  view.session = session;
  view.frame = frame;
  Request request;
  request.view = std::make_shared<const View>(view);
  request.slot = slot;
  request.rect = kRect;
  return request;
}

Result answering(SessionId session, FrameNumber frame, std::uint32_t slot) {
  Result result;
  result.session = session;
  result.frame = frame;
  result.slot = slot;
  return result;
}

TEST(AskedPictures, AcceptsEachAnswerOnce) {
  AskedPictures asked;
  asked.begin(1);
  asked.add(asking(1, 7, 3));
  EXPECT_FALSE(asked.take(answering(2, 7, 3)));
  EXPECT_FALSE(asked.take(answering(1, 6, 3)));
  EXPECT_FALSE(asked.take(answering(1, 7, 2)));
  EXPECT_EQ(asked.take(answering(1, 7, 3)), kRect);
  EXPECT_FALSE(asked.take(answering(1, 7, 3)));
}

/// Would catch a backend node that never answers and so has requests pile up.
TEST(AskedPictures, KeepsOnlyTheNewestFrames) {
  AskedPictures asked;
  asked.begin(1);
  for (FrameNumber frame = 1; frame <= AskedPictures::kFrames + 1; ++frame) asked.add(asking(1, frame, 0));
  EXPECT_FALSE(asked.take(answering(1, 1, 0)));
  EXPECT_TRUE(asked.take(answering(1, 2, 0)));
}

TEST(AskedPictures, ForgetsSessionsThatLeft) {
  AskedPictures asked;
  asked.begin(1);
  asked.add(asking(1, 1, 0));
  asked.end(1);
  asked.add(asking(1, 2, 0));
  EXPECT_FALSE(asked.take(answering(1, 1, 0)));
  EXPECT_FALSE(asked.take(answering(1, 2, 0)));
}

}  // namespace
}  // namespace grove::node
