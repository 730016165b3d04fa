#include "node/backend/peers/ended_frames.h"

#include <gtest/gtest.h>

namespace grove::node {
namespace {

View frameOf(SessionId session, FrameNumber frame) {
  View view;
  view.session = session;
  view.frame = frame;
  return view;
}

TEST(EndedFrames, IncludeAllUpToTheNewest) {
  EndedFrames ended;
  ended.add({.session = 1, .frame = 5});
  ended.add({.session = 1, .frame = 3});
  EXPECT_TRUE(ended.contain(frameOf(1, 5)));
  EXPECT_FALSE(ended.contain(frameOf(1, 6)));
  EXPECT_FALSE(ended.contain(frameOf(2, 1)));
  ended.forget(1);
  EXPECT_FALSE(ended.contain(frameOf(1, 5)));
}

TEST(EndedFrames, AreEmptyForANewSession) {
  EndedFrames ended;
  ended.add({.session = 1, .frame = 5});
  ended.addSession(1);
  ended.addSession(2);
  EXPECT_TRUE(ended.contain(frameOf(1, 5)));
  EXPECT_FALSE(ended.contain(frameOf(2, 1)));
  EXPECT_EQ(ended.sessions(), (std::vector<SessionId>{2, 1})) << "the newest first";
  ended.forget(2);
  EXPECT_EQ(ended.sessions(), (std::vector<SessionId>{1}));
}

/// Or who ends frames of sessions without end takes all memory.
TEST(EndedFrames, LimitTheNumberOfSessions) {
  EndedFrames ended;
  for (SessionId session = 1; session <= EndedFrames::kMaxSessions; ++session) ended.add({session, 1});
  ended.add({1, 2});
  ended.add({EndedFrames::kMaxSessions + 1, 1});
  EXPECT_TRUE(ended.contain(frameOf(1, 2)));
  EXPECT_FALSE(ended.contain(frameOf(2, 1))) << "it was silent longest";
  EXPECT_TRUE(ended.contain(frameOf(3, 1)));
}

}  // namespace
}  // namespace grove::node
