#include "world/scenes/toml_nesting.h"

#include <gtest/gtest.h>

#include <string>

namespace grove::world {
namespace {

std::string times(int count, const std::string& text) {
  std::string all;
  for (int i = 0; i < count; ++i) all += text;
  return all;
}

TEST(TomlNesting, NamesTheLineOfDeepNesting) {
  for (const char* const deep : {"x = [[[[1]]]]", "x = {a = {a = {a = {a = 1}}}}", "a.a.a.a.a = 1", "[a.a.a.a.a]",
                                 "[[a.a.a.a]]\n[a.a.a.a.a]", "a . a . 'a' . \"a\" . a = 1", "x = [\n[[[1]]]]"}) {
    EXPECT_TRUE(lineNestedDeeper(deep, 3).has_value()) << deep;
    EXPECT_EQ(
        lineNestedDeeper(std::string("\n# a comment\n") + deep, 3).value_or(0) - lineNestedDeeper(deep, 3).value_or(0),
        2U);
  }
}

TEST(TomlNesting, AcceptsWideTables) {
  for (const std::string& flat :
       {times(9, "[[object]]\n"), "x = [" + times(9, "1.5, ") + "]", times(9, "a.b.c = 1.5\n"),
        std::string("x = [[[1]]]"), std::string("[a.b.c.d]\nx = [[1.5], [2.5]]")}) {
    EXPECT_FALSE(lineNestedDeeper(flat, 3)) << flat;
  }
}

TEST(TomlNesting, IgnoresStringsAndComments) {
  for (const std::string& quiet :
       {std::string("# [[[[[ ....."), std::string("x = '[[[[[ .....'"), std::string("x = \"\\\"[[[[[ .....\""),
        std::string("x = '''\n[[[[[ .....''\n'''"), std::string("x = \"\"\"\\\"\"\"\\\"[[[[[\n.....\"\"\"")}) {
    EXPECT_FALSE(lineNestedDeeper(quiet, 3)) << quiet;
  }
}

TEST(TomlNesting, SeesCodeAfterStrings) {
  for (const std::string& text :
       {std::string("''"), std::string("\"\""), std::string("'a'"), std::string("'a\\'"), std::string("\"\\\\\""),
        std::string("''''''"), std::string("'''a''''"), std::string("\"\"\"a\"\"\"\"\""), std::string("'''\n'\n'''")}) {
    EXPECT_TRUE(lineNestedDeeper("x = [" + text + ", [[[[1]]]]]", 3)) << text;
  }
}

}  // namespace
}  // namespace grove::world
