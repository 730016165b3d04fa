#include "pipeline/reuse.h"

#include <gtest/gtest.h>

#include "pipeline/timeline.h"

namespace grove::pipeline {
namespace {

/// Would catch a part above 1 in a while in which older data became shared, and a division by nothing.
TEST(Reuse, SharedPartIsByBytesAndAtMostOne) {
  EXPECT_EQ(Reuse{}.sharedPart(), 0.0);
  EXPECT_EQ((Reuse{.made = 2, .shared = 1, .madeBytes = 400, .sharedBytes = 100}.sharedPart()), 0.25);
  EXPECT_EQ((Reuse{.made = 1, .shared = 3, .madeBytes = 100, .sharedBytes = 300}.sharedPart()), 1.0);
  EXPECT_EQ((Reuse{.used = 1, .shared = 3}.usedByOne()), 0U);
}

TEST(Reuse, IsCountedBySubject) {
  Timeline timeline;
  timeline.countReuse("lightfield", {.made = 1, .madeBytes = 10});
  const auto before = timeline.reuse();
  timeline.countReuse("lightfield", {.made = 2, .used = 2, .madeBytes = 20, .usesAgain = 5, .usesByOthers = 1});
  timeline.countReuse("box", {.made = 1});
  const auto after = timeline.reuse();
  EXPECT_EQ(after.at("lightfield") - before.at("lightfield"),
            (Reuse{.made = 2, .used = 2, .madeBytes = 20, .usesAgain = 5, .usesByOthers = 1}));
  EXPECT_EQ(after.at("box").made, 1U);
  EXPECT_EQ(after.at("lightfield").uses(), 8U);
}

}  // namespace
}  // namespace grove::pipeline
