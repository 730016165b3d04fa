#include "objects/builtin_backends.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

/// A program of backend halves alone, linked without any frontend.
namespace grove::objects {
namespace {

TEST(BuiltinBackends, AreThereForEveryType) {
  EXPECT_THAT(builtinBackends().names(),
              ::testing::UnorderedElementsAre("figure", "fluid", "ground", "lightfield", "mesh", "sky"));
}

}  // namespace
}  // namespace grove::objects
