#include "stream/protocol/printable.h"

#include <gtest/gtest.h>

namespace grove::stream {
namespace {

TEST(Printable, KeepsGoodText) {
  EXPECT_EQ(printable("Zoë 🔥 日本", 64), "Zoë 🔥 日本");
  EXPECT_EQ(printable("", 64), "");
}

TEST(Printable, ReplacesWhatIsNotUtf8) {
  EXPECT_EQ(printable("a\xFF"
                      "b\x80",
                      64),
            "a?b?");
  EXPECT_EQ(printable("\xC0\xAF", 64), "??");               // overlong
  EXPECT_EQ(printable("\xED\xA0\x80", 64), "???");          // surrogate
  EXPECT_EQ(printable("\xF4\x90\x80\x80", 64), "????");     // beyond the last character
  EXPECT_EQ(printable("cut \xF0\x9F\x94", 64), "cut ???");  // cut short
}

TEST(Printable, DropsWhatCannotBeSeen) {
  EXPECT_EQ(printable("a\r\n\x1B[31mb\x7F", 64), "a[31mb");
  EXPECT_EQ(printable("\u202Eevil\u200B\uFEFF\u0085", 64), "evil");
  EXPECT_EQ(printable("  Ada \n ", 64), "Ada");
}

TEST(Printable, CutsBetweenCharacters) {
  EXPECT_EQ(printable("ab🔥", 5), "ab");
  EXPECT_EQ(printable("ab🔥", 6), "ab🔥");
}

}  // namespace
}  // namespace grove::stream
