#include "objects/builtin_backends.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

/// A program of backend halves alone, linked without any frontend.
namespace grove::objects {
namespace {

TEST(BuiltinBackends, ExistForEveryType) {
  EXPECT_THAT(builtinBackends().names(),
              ::testing::UnorderedElementsAre("figure", "fluid", "ground", "herd", "lightfield", "mesh", "sky"));
}

TEST(BuiltinBackends, FluidsAndSkiesNeedNoForeignModels) {
  std::vector<std::string_view> content;
  const node::BackendTypes types = builtinBackends();
  for (const auto& type : types.all()) {
    if (!type->needsAllModels()) content.push_back(type->name());
  }
  EXPECT_THAT(content, ::testing::UnorderedElementsAre("fluid", "sky"));
}

}  // namespace
}  // namespace grove::objects
