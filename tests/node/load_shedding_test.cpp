#include "node/load_shedding.h"

#include <gtest/gtest.h>

namespace grove::node {
namespace {

TEST(LoadShedding, BeginsNearTheLimitOfTheMachine) {
  EXPECT_EQ(errorFactor(0.0), 1.0F);
  EXPECT_EQ(errorFactor(0.75), 1.0F);
  EXPECT_NEAR(errorFactor(0.85), 0.5F * (1.0F + kMaxErrorFactor), 1e-5F);
  EXPECT_EQ(errorFactor(1.0), kMaxErrorFactor);
}

}  // namespace
}  // namespace grove::node
