#include "stream/web_server/access/origin.h"

#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace grove::stream {
namespace {

TEST(KnownHost, IsAnAddressOrAName) {
  const std::vector<std::string> names{"Grove.example"};
  EXPECT_TRUE(isKnownHost("grove.example:443", names));
  EXPECT_TRUE(isKnownHost("grove.EXAMPLE", names));
  EXPECT_FALSE(isKnownHost("grove.example.evil", names));
  EXPECT_FALSE(isKnownHost("example", names));
}

TEST(Origin, ComparesHostAndPort) {
  const std::optional<bool> unknown;
  EXPECT_TRUE(isSameOrigin("http://grove.example:8080", "Grove.example:8080", unknown));
  EXPECT_TRUE(isSameOrigin("https://grove.example", "grove.example", unknown));
  EXPECT_TRUE(isSameOrigin("https://[2001:db8::1]:8080", "[2001:DB8::1]:8080", unknown));
  EXPECT_TRUE(isSameOrigin("https://grove.example", "grove.example:443", true)) << "written out by some proxies";
  EXPECT_FALSE(isSameOrigin("http://grove.example", "grove.example:8080", unknown));
  EXPECT_FALSE(isSameOrigin("http://grove.example", "grove.example:443", unknown));
  EXPECT_FALSE(isSameOrigin("http://grove.example.evil", "grove.example", unknown));
  EXPECT_FALSE(isSameOrigin("null", "null", unknown));
  EXPECT_FALSE(isSameOrigin("http://", "", unknown));
  EXPECT_FALSE(isSameOrigin("file:///x", "x", unknown));
}

TEST(Origin, ComparesScheme) {
  EXPECT_TRUE(isSameOrigin("https://grove.example", "grove.example", true));
  EXPECT_FALSE(isSameOrigin("http://grove.example", "grove.example", true));
  EXPECT_TRUE(isSameOrigin("http://grove.example", "grove.example", false));
  EXPECT_FALSE(isSameOrigin("https://grove.example", "grove.example", false));
}

TEST(Origin, ParsesOrRefuses) {
  EXPECT_EQ(parseOrigin("HTTPS://Example.org"), "https://example.org");
  EXPECT_EQ(parseOrigin("https://example.org:443"), "https://example.org");
  EXPECT_EQ(parseOrigin("http://example.org:443"), "http://example.org:443");
  EXPECT_EQ(parseOrigin("http://[::1]:80"), "http://[::1]");
  EXPECT_EQ(parseOrigin("http://192.0.2.1:8080"), "http://192.0.2.1:8080");
  for (const char* bad : {"",
                          "null",
                          "*",
                          "example.org",
                          "ws://example.org",
                          "https://",
                          "https://:443",
                          "https://example.org/",
                          "https://example.org/page",
                          "https://example.org:",
                          "https://example.org:0",
                          "https://example.org:65536",
                          "https://example.org:8o",
                          "https://ada@example.org",
                          "https://*.example.org",
                          "https://exa mple.org",
                          "https://[::1",
                          "https://[xyz]",
                          "https://::1",
                          "https://a\r\nb"}) {
    EXPECT_FALSE(parseOrigin(bad)) << bad;
  }
}

TEST(Origin, ForeignOriginsNeedTheirFullName) {
  const std::vector<std::string> origins{"https://example.org"};
  EXPECT_TRUE(isOneOf(origins, "https://example.org"));
  EXPECT_FALSE(isOneOf(origins, "http://example.org"));
  EXPECT_FALSE(isOneOf(origins, "https://example.org:8443"));
  EXPECT_FALSE(isOneOf(origins, "https://example.org.evil"));
  EXPECT_FALSE(isOneOf(origins, "https://sub.example.org"));
  EXPECT_FALSE(isOneOf(origins, "null"));
  EXPECT_FALSE(isOneOf({}, ""));
}

}  // namespace
}  // namespace grove::stream
