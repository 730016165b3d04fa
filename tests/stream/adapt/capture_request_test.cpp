#include "stream/adapt/capture_request.h"

#include <gtest/gtest.h>

namespace grove::stream {
namespace {

// Faults: a frame that is nobody's capture; a capture that is handed out twice, or of another frame.
TEST(CaptureRequest, BelongsToOneFrame) {
  CaptureRequest request;
  EXPECT_FALSE(request.begin(1, 10.0));
  request.ask(7);
  EXPECT_TRUE(request.begin(2, 10.1));
  EXPECT_FALSE(request.begin(3, 10.2));
  EXPECT_FALSE(request.take(1));
  EXPECT_EQ(request.take(2), 7U);
  EXPECT_FALSE(request.take(2));
}

// Fault: a visitor who asks for captures all the time, and gets one in every frame.
TEST(CaptureRequest, AnswersTheNewestOncePerSecond) {
  CaptureRequest request;
  int answers = 0;
  for (std::uint32_t frame = 1; frame <= 300; ++frame) {
    request.ask(frame);
    if (!request.begin(frame, frame / 30.0)) continue;
    ++answers;
    EXPECT_EQ(request.take(frame), frame);
  }
  EXPECT_GE(answers, 9);
  EXPECT_LE(answers, 11);
}

}  // namespace
}  // namespace grove::stream
