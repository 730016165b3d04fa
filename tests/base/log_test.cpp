#include "base/log.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <thread>

namespace grove::log {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

TEST(LimitedLog, WritesOneLinePerSecondAndCounts) {
  Limited limited;
  testing::internal::CaptureStderr();
  for (int i = 0; i < 1000; ++i) limited.warning("flooded " + std::to_string(i));
  EXPECT_THAT(testing::internal::GetCapturedStderr(), AllOf(HasSubstr("flooded 0"), Not(HasSubstr("flooded 1"))));
  std::this_thread::sleep_for(std::chrono::milliseconds(1100));
  testing::internal::CaptureStderr();
  limited.error("again");
  EXPECT_THAT(testing::internal::GetCapturedStderr(), AllOf(HasSubstr("999"), HasSubstr("again"), HasSubstr("error")));
}

}  // namespace
}  // namespace grove::log
