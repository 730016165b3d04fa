#include "base/utf8.h"

#include <gtest/gtest.h>

namespace grove::utf8 {
namespace {

TEST(Utf8, AcceptsValidText) {
  for (const char* good :
       {"", "Ada", "Zo\xC3\xAB", "\xE2\x82\xAC", "\xED\x9F\xBF", "\xF0\x9F\x94\xA5", "\xF4\x8F\xBF\xBF"}) {
    EXPECT_TRUE(isValid(good)) << good;
  }
  EXPECT_TRUE(isValid(std::string_view("\0", 1)));
}

TEST(Utf8, RefusesInvalidText) {
  for (const char* bad :
       {"\x80", "\xC3", "a\xC3", "\xC0\x80", "\xC1\xBF", "\xE0\x9F\xBF", "\xED\xA0\x80", "\xF0\x8F\xBF\xBF",
        "\xF4\x90\x80\x80", "\xF5\x80\x80\x80", "\xFF", "\xE2\x82", "\xC3(", "\xE2\x82("}) {
    EXPECT_FALSE(isValid(bad)) << bad;
  }
}

TEST(Utf8, SanitizesAnyBytes) {
  EXPECT_EQ(repaired("a\xFF\xC3\xAB\xC3", 100), "a?\xC3\xAB?");
  EXPECT_EQ(repaired("abc", 2), "ab");
  EXPECT_EQ(repaired("a\xC3\xAB", 2), "a") << "half a character";
}

}  // namespace
}  // namespace grove::utf8
