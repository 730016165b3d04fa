#include "stream/protocol/printable.h"

#include <gtest/gtest.h>

namespace grove::stream {
namespace {

TEST(Printable, KeepsGoodText) {
  EXPECT_EQ(printable("Zoë 🔥 日本", 64), "Zoë 🔥 日本");
  EXPECT_EQ(printable("", 64), "");
}

TEST(Printable, ReplacesInvalidUtf8) {
  EXPECT_EQ(printable("a\xFF"
                      "b\x80",
                      64),
            "a?b?");
  EXPECT_EQ(printable("\xC0\xAF", 64), "??");               // overlong
  EXPECT_EQ(printable("\xED\xA0\x80", 64), "???");          // surrogate
  EXPECT_EQ(printable("\xF4\x90\x80\x80", 64), "????");     // beyond the last character
  EXPECT_EQ(printable("cut \xF0\x9F\x94", 64), "cut ???");  // cut short
}

TEST(Printable, DropsInvisibleCharacters) {
  EXPECT_EQ(printable("a\r\n\x1B[31mb\x7F", 64), "a[31mb");
  EXPECT_EQ(printable("\u202Eevil\u202C\u200B\uFEFF\u0085", 64), "evil");
  EXPECT_EQ(printable("  Ada \n ", 64), "Ada");
}

/// A name of these alone would be an empty one over somebody's head, or another's name with something hidden in it.
TEST(Printable, DropsBlankAndIgnorableCharacters) {
  for (const char* blank : {"\u3164", "\u115F", "\u1160", "\uFFA0", "\u2800", "\u00AD", "\u034F", "\u061C", "\u180E",
                            "\u200D", "\u2066\u2069", "\uFE0F", "\U000E0001", "\U000E0041", "\U000E0100", "\u3000"}) {
    EXPECT_EQ(printable(blank, 64), "");
    EXPECT_EQ(printable(std::string("Ada") + blank, 64), "Ada");
  }
  EXPECT_EQ(printable("Ada\u2003Zoë", 64), "Ada Zoë");
}

TEST(Printable, LimitsStacksOfAccents) {
  std::string stack = "Z";
  for (int i = 0; i < 30; ++i) stack += "\u0301";
  EXPECT_EQ(printable(stack + "oe", 64), "Z\u0301\u0301oe");
  EXPECT_EQ(printable("e\u0323\u0302e\u0323\u0302", 64), "e\u0323\u0302e\u0323\u0302") << "Vietnamese";
  EXPECT_EQ(printable("\u0301Ada", 64), "Ada") << "nothing carries it";
}

TEST(Printable, TruncatesBetweenCharacters) {
  EXPECT_EQ(printable("ab🔥", 5), "ab");
  EXPECT_EQ(printable("ab🔥", 6), "ab🔥");
}

}  // namespace
}  // namespace grove::stream
