#include "stream/load/load_target.h"

#include <gtest/gtest.h>

namespace grove::stream {
namespace {

TEST(LoadUrl, ParsesOrRefuses) {
  const auto target = parseLoadUrl("ws://127.0.0.1:8099/");
  ASSERT_TRUE(target);
  EXPECT_EQ(target->host, "127.0.0.1");
  EXPECT_EQ(target->port, 8099);
  EXPECT_EQ(parseLoadUrl("ws://grove.example")->port, 80);
  EXPECT_EQ(parseLoadUrl("ws://[::1]:9")->host, "::1");
  EXPECT_FALSE(target->isSecure);
  EXPECT_TRUE(parseLoadUrl("wss://grove.example:8443/")->isSecure);
  EXPECT_EQ(parseLoadUrl("wss://grove.example")->port, 443);
  for (const char* bad : {"", "http://x/", "ws://", "ws://x:", "ws://x:0/", "ws://x:70000", "ws://x:1a", "ws://x/path",
                          "wss://", "wsss://x"}) {
    EXPECT_FALSE(parseLoadUrl(bad)) << bad;
  }
}

}  // namespace
}  // namespace grove::stream
