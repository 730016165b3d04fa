#include "base/name_list.h"

#include <gtest/gtest.h>

namespace grove {
namespace {

TEST(NameList, FitsOneLine) {
  EXPECT_EQ(nameList({}), "");
  EXPECT_EQ(nameList({"a"}), "a");
  EXPECT_EQ(nameList({"a", "b"}), "a, b");
  EXPECT_EQ(nameList(std::vector<std::string>(8, "x")), "x, x, x, x, x, x, x, x");
  EXPECT_EQ(nameList(std::vector<std::string>(1000, "x")), "x, x, x, x, x, x, x, x and 992 more");
  EXPECT_EQ(nameList({"two\nlines", "\033[31mred"}), "two?lines, ?[31mred");
  EXPECT_EQ(nameList({std::string(1000, 'x')}), std::string(64, 'x'));
}

}  // namespace
}  // namespace grove
